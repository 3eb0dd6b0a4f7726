// The order in which the workgroups of an image run. A driver that runs on processors gives each of its threads as many
// turns that follow each other as the others (llvmpipe: lp_cs_tpool.c). Most of an image's work is where the model is: in
// the order of the image one thread would have more of it than another, and the others would wait for it.

// Which of `count` things has this turn, 0 <= turn < count, if each is `stride` after the one before: 0, stride, 2 stride, ...,
// then 1, 1 + stride, ... Each of them has one turn.
uint in_turn(uint turn, uint count, uint stride) {
  uint shorter = count / stride;
  uint longer = shorter + 1u;
  // So many rounds have a turn more than the others.
  uint longer_rounds = count % stride;
  uint in_longer_rounds = longer_rounds * longer;
  if (turn < in_longer_rounds) return turn % longer * stride + turn / longer;
  uint rest = turn - in_longer_rounds;
  return rest % shorter * stride + longer_rounds + rest / shorter;
}

// Workgroups that follow each other wherever they are: neighbours in the image, which read the same of the scene.
const uint WORKGROUP_RUN = 8u;

// Which of `count` workgroups has this turn, if each run is `stride` runs after the one before. Those that make no whole run
// are the last.
uint workgroup_in_turn(uint turn, uint count, uint stride) {
  uint runs = count / WORKGROUP_RUN;
  if (turn >= runs * WORKGROUP_RUN) return turn;
  return in_turn(turn / WORKGROUP_RUN, runs, stride) * WORKGROUP_RUN + turn % WORKGROUP_RUN;
}

// The workgroup of the image that a kernel's own is, in the first pass of a part.
#define GROUP_IN_TURN (push.first_group + workgroup_in_turn(gl_WorkGroupID.x, gl_NumWorkGroups.x, push.stride))
