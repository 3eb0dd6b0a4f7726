// What a lane of the subgroup has loaded, for all of them. Words are loaded and broadcast as integers, and only then taken
// for floats: a device may flush denormals, which small integers among the words are.

// lane: a constant, as SPIR-V before 1.5 demands.
#define broadcast_floats(loaded, lane) uintBitsToFloat(subgroupBroadcast(loaded, lane))
