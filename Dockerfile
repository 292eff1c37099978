# kedge on Debian 12:  docker build -t kedge .
#   docker run --rm -v "$PWD:/scenes" kedge SCENE.prm
FROM debian:12 AS build
RUN apt-get update && apt-get install -y --no-install-recommends \
    cmake g++ libdeal.ii-dev libopenblas0-pthread ninja-build openmpi-bin dpkg-dev file
COPY . /source
RUN cmake -S /source -B /build -G Ninja -D KEDGE_NATIVE=OFF -D KEDGE_TESTS=OFF \
    && ninja -C /build kedge kedge_library \
    && cd /build && cpack -G DEB && mv kedge_*.deb /kedge.deb

FROM debian:12
COPY --from=build /kedge.deb /tmp/kedge.deb
RUN apt-get update && apt-get install -y /tmp/kedge.deb && rm /tmp/kedge.deb
WORKDIR /scenes
ENTRYPOINT ["kedge"]
