// The control points of control_net.glsl in two or three dimensions: POINT is the vector type, NET and TANGENTS are
// the names of the structs, CONTROL_NET that of the function.

// Control points; b_ijk belongs to the Bernstein polynomial of l_0^i l_1^j l_2^k. They are members, not an array, and
// whoever goes through all ten does it by hand: GLSL compilers put an array that a loop indexes into memory instead of
// registers.
struct NET {
  POINT b300;
  POINT b030;
  POINT b003;
  POINT b210;
  POINT b120;
  POINT b021;
  POINT b012;
  POINT b102;
  POINT b201;
  POINT b111;
};

// Control vectors of a net's derivatives by the weights 1 and 2 within its sub-triangle, divided by 3. u_i and v_i
// belong to the same Bernstein polynomial: at each point S_u and S_v of the net are the same convex combination of
// the six u_i and of the six v_i.
struct TANGENTS {
  POINT u0;
  POINT u1;
  POINT u2;
  POINT u3;
  POINT u4;
  POINT u5;
  POINT v0;
  POINT v1;
  POINT v2;
  POINT v3;
  POINT v4;
  POINT v5;
};

NET CONTROL_NET(FramedPatch framed, vec3 corner, vec3 edge, SubTriangle node) {
  vec3 a = weights_of(node, vec3(1.0, 0.0, 0.0));
  vec3 b = weights_of(node, vec3(0.0, 1.0, 0.0));
  vec3 c = weights_of(node, vec3(0.0, 0.0, 1.0));
  POINT P0 = POINT(framed.P0);
  POINT P1 = POINT(framed.P1);
  POINT P2 = POINT(framed.P2);
  POINT D0 = POINT(framed.D0);
  POINT D1 = POINT(framed.D1);
  POINT D2 = POINT(framed.D2);
  POINT Ta = P0 * a.x + P1 * a.y + P2 * a.z;
  POINT Tb = P0 * b.x + P1 * b.y + P2 * b.z;
  POINT Tc = P0 * c.x + P1 * c.y + P2 * c.z;
  POINT Da = D0 * a.x + D1 * a.y + D2 * a.z;
  POINT Db = D0 * b.x + D1 * b.y + D2 * b.z;
  POINT Dc = D0 * c.x + D1 * c.y + D2 * c.z;
  real qaa = blossom(corner, edge, a, a);
  real qbb = blossom(corner, edge, b, b);
  real qcc = blossom(corner, edge, c, c);
  real qab = blossom(corner, edge, a, b);
  real qbc = blossom(corner, edge, b, c);
  real qca = blossom(corner, edge, c, a);
  const real third = real(1.0) / real(3.0);
  EXACT NET net;
  net.b300 = Ta + Da * qaa;
  net.b030 = Tb + Db * qbb;
  net.b003 = Tc + Dc * qcc;
  net.b210 = (Ta * real(2.0) + Tb + Db * qaa + Da * (real(2.0) * qab)) * third;
  net.b120 = (Tb * real(2.0) + Ta + Da * qbb + Db * (real(2.0) * qab)) * third;
  net.b021 = (Tb * real(2.0) + Tc + Dc * qbb + Db * (real(2.0) * qbc)) * third;
  net.b012 = (Tc * real(2.0) + Tb + Db * qcc + Dc * (real(2.0) * qbc)) * third;
  net.b102 = (Tc * real(2.0) + Ta + Da * qcc + Dc * (real(2.0) * qca)) * third;
  net.b201 = (Ta * real(2.0) + Tc + Dc * qaa + Da * (real(2.0) * qca)) * third;
  net.b111 = (Ta + Tb + Tc + Da * qbc + Db * qca + Dc * qab) * third;
  return net;
}

TANGENTS tangents(NET net) {
  TANGENTS t;
  t.u0 = net.b210 - net.b300;
  t.u1 = net.b030 - net.b120;
  t.u2 = net.b012 - net.b102;
  t.u3 = net.b120 - net.b210;
  t.u4 = net.b111 - net.b201;
  t.u5 = net.b021 - net.b111;
  t.v0 = net.b201 - net.b300;
  t.v1 = net.b021 - net.b120;
  t.v2 = net.b003 - net.b102;
  t.v3 = net.b111 - net.b210;
  t.v4 = net.b102 - net.b201;
  t.v5 = net.b012 - net.b111;
  return t;
}
