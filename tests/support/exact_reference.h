// tests/support: the sign of a cell's volume by integers of any length: slow, simple, and with
// nothing in common with the library's own predicate.
#pragma once

namespace tetstream::test {

// Sign of det(b - a, c - a, d - a) of any finite doubles.
int referenceOrientation(const double a[3], const double b[3], const double c[3],
                         const double d[3]);

}  // namespace tetstream::test
