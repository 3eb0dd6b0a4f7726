# Points and normals out of a depth picture: unproject.py Z.pfm N.pfm FIGURES.json POINTS.ply
import json
import sys

import numpy as np


def read_pfm(name):
    with open(name, "rb") as file:
        components = 3 if file.readline() == b"PF\n" else 1
        width, height = map(int, file.readline().split())
        order = "<f4" if float(file.readline()) < 0 else ">f4"
        return np.frombuffer(file.read(), order).reshape(height, width, components)[::-1]


depth, normals = read_pfm(sys.argv[1])[..., 0].astype(float), read_pfm(sys.argv[2])
with open(sys.argv[3]) as file:
    camera = json.load(file)["camera"]
eye, target, up = (np.array(camera[name]) for name in ("eye", "target", "up"))
ahead = (target - eye) / np.linalg.norm(target - eye)
right = np.cross(ahead, up) / np.linalg.norm(np.cross(ahead, up))
down = np.cross(ahead, right)
height, width = depth.shape
pixel = 2 * np.tan(np.radians(camera["fov"]) / 2) / height
y, x = np.mgrid[:height, :width] + 0.5
rays = ahead + pixel * ((x - width / 2)[..., None] * right + (y - height / 2)[..., None] * down)
points = eye + depth[..., None] * rays / np.linalg.norm(rays, axis=-1, keepdims=True)

hit = depth > 0
properties = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
header = f"ply\nformat ascii 1.0\nelement vertex {hit.sum()}\n{properties}end_header"
np.savetxt(sys.argv[4], np.hstack([points[hit], normals[hit]]), "%.9g", header=header, comments="")
