# kedge on Debian 12:  docker build -t kedge .
#   docker run --rm -v "$PWD:/scenes" kedge SCENE.prm
FROM debian:12 AS build
ARG DEBIAN_FRONTEND=noninteractive
RUN apt-get update && apt-get install -y --no-install-recommends \
    cmake g++ libdeal.ii-dev libopenblas0-pthread ninja-build openmpi-bin dpkg-dev file
COPY . /source
RUN cmake -S /source -B /build -G Ninja -D KEDGE_NATIVE=OFF -D KEDGE_TESTS=OFF \
    && ninja -C /build kedge kedge_library \
    && cd /build && cpack -G DEB && mv kedge_*.deb /kedge.deb

FROM debian:12
ARG DEBIAN_FRONTEND=noninteractive
COPY --from=build /kedge.deb /tmp/kedge.deb
RUN apt-get update \
    && apt-get install -y --no-install-recommends \
       /tmp/kedge.deb openmpi-bin python3-matplotlib python3-numpy \
    && rm -rf /tmp/kedge.deb /var/lib/apt/lists/*
WORKDIR /scenes
ENTRYPOINT ["kedge"]
