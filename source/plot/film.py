"""An animation of the body, one frame for each output time."""
import io
import shutil
import subprocess

from PIL import Image

import style
from vtu_reader import BadFile

plt = style.plt

MOST_FRAMES = 200
SECONDS_LONG = 8.0 # of a film


def frames(picture):
    """The frames one by one, all with the same limits and colours."""
    entries = picture.series[::max(1, -(-len(picture.series) // MOST_FRAMES))]
    states, values, fields = picture.load(entries)
    low, high = picture.limits(states, [time for time, _ in entries])
    scaling = picture.scaling(values)
    ratio = (high - low)[1] / (high - low)[0]
    for (time, _), *rest in zip(entries, states, values, fields):
        figure, panel = plt.subplots(figsize=(7.5, min(max(6 * ratio + 0.8, 2.5), 8)))
        drawn = picture.draw(panel, *rest, scaling)
        picture.finish_panel(panel, time, low, high)
        picture.add_legend(figure, panel, drawn, scaling[1])
        data = io.BytesIO()
        figure.savefig(data, format="png", dpi=100)
        plt.close(figure)
        data.seek(0)
        yield Image.open(data).convert("RGB")


def write_film(picture, path):
    """Writes .gif, or .mp4 with ffmpeg; returns the path."""
    images = list(frames(picture))
    rate = max(2, min(30, round(len(images) / SECONDS_LONG)))
    if path.suffix == ".gif":
        palette = [image.quantize(64) for image in images]
        palette[0].save(path, save_all=True, append_images=palette[1:], duration=1000 // rate,
                        loop=0)
        return path
    if shutil.which("ffmpeg") is None:
        raise BadFile("an mp4 needs the program ffmpeg (apt-get install ffmpeg); gif does not")
    width, height = (size - size % 2 for size in images[0].size)
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgb24",
               "-video_size", f"{width}x{height}", "-framerate", str(rate), "-i", "-",
               "-pix_fmt", "yuv420p", str(path)]
    data = b"".join(image.crop((0, 0, width, height)).tobytes() for image in images)
    done = subprocess.run(command, input=data, capture_output=True, check=False)
    if done.returncode != 0:
        raise BadFile(f"ffmpeg could not write {path}: {done.stderr.decode(errors='replace')}")
    return path
