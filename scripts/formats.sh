#!/bin/bash
# Renders every model of Debian's assimp-testmodels in the formats that trisect reads, and writes docs/formats.md with what
# became of each and docs/formats.jpg with the pictures (two minutes). Fails if one takes ten seconds, or ends in any way but
# a picture or one sentence.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=/usr/share/assimp/models

pictures=()
number=0
{
  cat <<END
# Models

Written by \`scripts/formats.sh\` with Debian's assimp-testmodels $(dpkg-query -W -f '${Version}' assimp-testmodels).

| format | read by | what of it |
|---|---|---|
| OBJ | tinyobjloader | polygons, normals, smoothing groups, colours of materials; ASCII, UTF-8, UTF-16 |
| glTF 2.0, GLB | nlohmann-json, Draco, meshoptimizer | the scene's nodes with their transformations; triangles, strips, fans; morph targets and skins at rest; sparse and quantised accessors; base colours of materials and COLOR_0; KHR_draco_mesh_compression, EXT_meshopt_compression |
| PLY | Assimp | polygons, normals and colours of vertices, ASCII and binary |
| STL | Assimp | facets, ASCII and binary; normals are made, for it has one for each facet only |
| FBX | Assimp | all meshes with the transformations of their nodes, colours of materials |

The format is told by the content, or, where that says nothing, by the ending of the name. Each may be compressed by gzip.
Points and lines are left out. A triangle has one colour, the mean of its vertices' where those have some; textures are not
read, and a material with one has no colour here. Not read are colours of OBJ's vertices and what some programs write into STL
for colours. Material files of OBJ are read in the model's folder and below, links followed. Units and axes stay as they are in the file. glTF is not read by tinygltf or Assimp because
tinygltf 2.7 refuses buffers that only stand in for compressed ones and reads Draco's views unchecked, and Assimp 5.2 takes
no quantised positions.

Reading 450,000 triangles and making a mesh of them takes 5.9 times the file's size of memory in binary PLY, 5.4 in binary STL
and 5.2 in GLB: the test ModelFile.ReadsInSixTimesItsSize prints it and holds it to 6.

## Rays and hits

\`trisect rays\` writes lists of rays, \`trisect cast\` and \`trisect judge\` read them; \`cast\` writes lists of hits and \`judge\` reads
them, one hit for each ray, in their order. A name that ends in .csv is text, any other binary: records of little-endian numbers,
without a header.

| bytes of a ray | single precision | bytes of a hit | |
|---|---|---|---|
| 0 to 11 | origin: x, y, z | 0 to 3 | t, single precision |
| 12 to 15 | t_min | 4 to 11 | u, v, single precision |
| 16 to 27 | direction: x, y, z | 12 to 15 | triangle, an unsigned whole number |
| 28 to 31 | t_max | | |

A text has a line for each, \`ox,oy,oz,t_min,dx,dy,dz,t_max\` or \`t,u,v,triangle\`; a line with these names may come first. Numbers
may have the digits of double precision.

Coordinates are those of the model, whose positions are rounded to single precision, as other programs have them. A ray is origin + t
direction for t_min <= t <= t_max; t_max may be infinite, the direction has any length, and t counts in it. u and v are the weights
of the triangle's second and third vertex; they may be left out (NaN, in a text nothing). Triangles are counted from 0 on, in the
order in which \`trisect export MODEL --surface flat --subdivide 1\` writes them: the model's own, where it has triangles only. No
hit is 4294967295, in a text -1; a hit on a triangle that is not told is 4294967294, in a text nothing. In Python:

\`\`\`python
import numpy
rays = numpy.fromfile("a.rays", "<f4").reshape(-1, 8)
hits = numpy.fromfile("a.hits", [("t", "<f4"), ("u", "<f4"), ("v", "<f4"), ("triangle", "<u4")])
\`\`\`

## The test models

![All of them](formats.jpg)

|  | file | triangles | what trisect says |
|---|---|---|---|
END
  while IFS= read -r file; do
    number=$((number + 1))
    picture=$work/$(printf %03d $number).png
    code=0
    timeout 10 build/release/trisect render "$models/$file" --size 200x150 --spp 4 -o "$picture" --stats "$work/a.json" \
      >"$work/out" 2>"$work/err" || code=$?
    if [ $code = 0 ]; then
      said=$(head -1 "$work/out")
      triangles=$(jq .patches "$work/a.json")
      pictures+=(-label "$number" "$picture")
    else
      said=$(cat "$work/err")
      triangles=""
      if [ $code != 3 ] || [ "$(wc -l <"$work/err")" != 1 ]; then
        echo "$file: exit $code: $said" >&2
        exit 1
      fi
    fi
    said=${said//"$models/$file"/}
    said=$(sed -E 's/^trisect: //; s/^[:,] //; s/^[0-9]+ triangles, //' <<<"$said")
    printf '| %d | %s | %s | %s |\n' $number "$file" "$triangles" "${said//"$models/"/}"
  done < <(cd "$models" && find . -type f -regextype posix-extended -iregex '.*\.(obj|gltf|glb|ply|stl|fbx)' -printf '%P\n' | LC_ALL=C sort)
} >"$work/formats.md"
montage "${pictures[@]}" -tile 12x -geometry 100x75+2+2 -pointsize 9 -quality 80 "$work/formats.jpg"
mv "$work/formats.md" "$work/formats.jpg" docs
