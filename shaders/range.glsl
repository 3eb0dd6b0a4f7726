// Interval arithmetic of the kernels: a Range holds all numbers from lo to hi. The results are not rounded outward: what
// uses them adds a slack for its roundings, in proportion to the numbers that are added up. C++ that must prove something
// compiles the same formulas with app/base/interval.h, whose operations of these names round outward.

struct Range {
  real lo;
  real hi;
};

Range between(real lo, real hi) {
  Range a;
  a.lo = lo;
  a.hi = hi;
  return a;
}

// The range that holds both.
Range range_hull(Range a, Range b) { return between(min(a.lo, b.lo), max(a.hi, b.hi)); }

// What is in both; lo > hi if nothing is.
Range range_intersection(Range a, Range b) { return between(max(a.lo, b.lo), min(a.hi, b.hi)); }

Range range_clamp(Range a, real lo, real hi) { return between(clamp(a.lo, lo, hi), clamp(a.hi, lo, hi)); }

real range_magnitude(Range a) { return max(abs(a.lo), abs(a.hi)); }

Range range_grown(Range a, real by) { return between(a.lo - by, a.hi + by); }

Range range_minus(Range a) { return between(-a.hi, -a.lo); }

Range range_sum(Range a, Range b) { return between(a.lo + b.lo, a.hi + b.hi); }

// Times k >= 0.
Range range_scaled(Range a, real k) { return between(a.lo * k, a.hi * k); }

Range range_product(Range a, Range b) {
  Range c = between(a.lo * b.lo, a.hi * b.lo);
  Range d = between(a.lo * b.hi, a.hi * b.hi);
  return between(min(min(c.lo, c.hi), min(d.lo, d.hi)), max(max(c.lo, c.hi), max(d.lo, d.hi)));
}

// For b > 0.
Range range_quotient(Range a, Range b) {
  return between(a.lo / (a.lo < real(0.0) ? b.lo : b.hi), a.hi / (a.hi < real(0.0) ? b.hi : b.lo));
}

Range range_square(Range a) {
  real least_size = max(max(a.lo, -a.hi), real(0.0));
  real most_size = range_magnitude(a);
  return between(least_size * least_size, most_size * most_size);
}

// The square root of max(a, 0).
Range range_root(Range a) { return between(sqrt(max(a.lo, real(0.0))), sqrt(max(a.hi, real(0.0)))); }
