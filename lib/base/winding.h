// base: which way round a triangle is wound, told by its corners' numbers. Depends on nothing.
#pragma once

namespace tetstream {

// Whether three different numbers are a rotation of c b a, where a < b < c; else they are one of
// a b c. Triangles of the same corners are wound the same way if this is the same.
template <class Number>
bool isWoundDown(const Number corners[3]) {
  return (corners[0] > corners[1]) ^ (corners[1] > corners[2]) ^ (corners[0] > corners[2]);
}

}  // namespace tetstream
