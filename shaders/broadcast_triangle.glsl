// The triangle with this index, which is the same for all invocations of a subgroup, of which there are eight at least. Each
// lane loads other words of it and broadcasts them.
const uint TRIANGLE_WORDS = 12u;
const uint TRIANGLE_SHARE_BYTES = 32u;  // that a lane loads

Triangle load_triangle(uint triangle) {
  uint lane = gl_SubgroupInvocationID;
  uint base = triangle * TRIANGLE_WORDS;
  uvec4 loaded = triangle_words[base + (lane & 7u)];
  Triangle tri;
  tri.Position[0] = broadcast_floats(loaded, 0);
  tri.Position[1] = broadcast_floats(loaded, 1);
  tri.Position[2] = broadcast_floats(loaded, 2);
  tri.Normal[0] = broadcast_floats(loaded, 3);
  tri.Normal[1] = broadcast_floats(loaded, 4);
  tri.Normal[2] = broadcast_floats(loaded, 5);
  tri.TriNormal = broadcast_floats(loaded, 6);
  tri.NormDot = broadcast_floats(loaded, 7);
  loaded = triangle_words[base + 8u + (lane & 3u)];
  tri.Domain = broadcast_floats(loaded, 0);
  tri.VertexData[0] = broadcast_floats(loaded, 1);
  tri.VertexData[1] = broadcast_floats(loaded, 2);
  tri.VertexData[2] = broadcast_floats(loaded, 3);
  return tri;
}
