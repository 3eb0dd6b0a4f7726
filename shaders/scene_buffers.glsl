// The scene: triangles, subpatch bounds and, with TRISECT_BVH, the BVH. With TRISECT_ADDRESSES the kernel reaches them by
// device addresses, which have no limit of size as bindings have; triangles[i] and so on are written alike in both cases.
#ifdef TRISECT_ADDRESSES
layout(std140, binding = BINDING_ADDRESSES) uniform AddressesBlock { Addresses addresses; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer TrianglesAt { Triangle items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer SubpatchesAt { SubpatchBounds items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer BvhAt { BvhNode items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer WordsAt { uvec4 items[]; };
#define triangles TrianglesAt(uvec2(addresses.triangles_low, addresses.triangles_high)).items
#define triangle_words WordsAt(uvec2(addresses.triangles_low, addresses.triangles_high)).items
#define subpatches SubpatchesAt(uvec2(addresses.subpatches_low, addresses.subpatches_high)).items
#define subpatch_words WordsAt(uvec2(addresses.subpatches_low, addresses.subpatches_high)).items
#define bvh BvhAt(uvec2(addresses.bvh_low, addresses.bvh_high)).items
#define bvh_words WordsAt(uvec2(addresses.bvh_low, addresses.bvh_high)).items
#else
layout(std430, binding = BINDING_TRIANGLES) readonly restrict buffer TrianglesBlock { Triangle triangles[]; };
layout(std430, binding = BINDING_SUBPATCHES) readonly restrict buffer SubpatchesBlock { SubpatchBounds subpatches[]; };
// These once more, as arrays of words, of which floats keep their bits on every device; and the BVH.
#if defined(TRISECT_BVH) || defined(TRISECT_WORDS)
layout(std430, binding = BINDING_TRIANGLES) readonly restrict buffer TriangleWordsBlock { uvec4 triangle_words[]; };
#endif
#ifdef TRISECT_BVH
layout(std430, binding = BINDING_SUBPATCHES) readonly restrict buffer SubpatchWordsBlock { uvec4 subpatch_words[]; };
layout(std430, binding = BINDING_BVH) readonly restrict buffer BvhBlock { BvhNode bvh[]; };
layout(std430, binding = BINDING_BVH) readonly restrict buffer BvhWordsBlock { uvec4 bvh_words[]; };
#endif
#endif
