// simplify/state: how much the shapes of sheets should count beside the fields. Depends on
// schema.h.
//
// One weight of the boundary does not suit all: where it bends more than the fields do, nearly all
// vertices that are left lie on it, and few more inside would halve the fields' error. The weight
// with the least product of the RMS errors of the fields and of the sheet is looked for, downwards
// from the one that was asked for; of the boundary and of interfaces at once, where both bend,
// since either takes what is left of the other. Errors are foretold from a sample of the mesh as it
// comes:
//   What is added by taking a vertex out, c, grows with the length of edges, s times that of the
//   input: inside as s^7 (a squared error, s^4, times a volume), on a sheet as s^6 (s^4 times an
//   area), and of such vertices s^-3 or s^-2 are left. In the end all cost the same, t, so that
//   s = (t / c)^(1/7) or (t / c)^(1/6), where that is more than 1; t is what leaves the ratio of
//   vertices that is asked for. Errors are the sums of what was added for those that are left, and
//   nothing where s is 1. Which ways vertices go changes with the weight, and c with that.
// Where much of the boundary lies upon itself, as at a contact of two bodies or at a crack, fields
// may jump from one side to the other: what it is off by is an error of theirs, and its weight
// stays. Interfaces that are rough, as where cells have the label of the side that their centres
// lie on, or where all vertices were moved by chance, are another matter: what bends there is noise
// of the size of the input's cells, and no cell of the output is small enough for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "schema.h"

namespace tetstream {

// How the values of a measured field differ; kOutOfReach: by what cannot be divided by.
enum class Variation : uint8_t { kVaries, kOutOfReach, kByRounding, kConstant };

// What interfaces count, of a boundary face, where fields are measured: they would pay with the
// shape of interfaces, at which they have their kinks. Without fields there is only the boundary to
// pay for interfaces. Sheets inside a region, antennas or cracks, are small beside the cells far
// from them, with whose shapes they would pay: of a ring in a box 3000 times as wide as it is the
// distance is a fifth.
constexpr double kInterfaceShare = 50;

// Times the weight of all sheets, and that of interfaces besides; 1 where it is not known.
struct Balance {
  double outer = 1, interfaces = 1;
  std::vector<double> fields;     // times each one's weight (field_weights.h); or none
  std::vector<Variation> varies;  // each field's values; or none
  bool knows_outer = false, knows_interfaces = false;
  bool rough_interfaces = false;
};

// What counts for more or less than it was given, for the report; or nothing. Interfaces are named
// only where there are any.
std::string inWords(const Balance& balance, bool has_interfaces, const std::vector<Column>& fields);

// What taking a vertex out to one of its neighbours adds to the error of the fields and, with the
// weight that was asked for, to that of the sheet that it lies on.
struct Removal {
  double field, sheet;
};
// The ways that a vertex may go, or what it may be expected to cost alone.
using Ways = std::vector<Removal>;

// Of what going to each of a vertex's neighbours costs, that where a third of them cost less: what
// it may be expected to cost. The cheapest would be too cheap: along a cylinder half of all
// vertices go for nothing, then none. What is no number counts as nothing. Reorders them.
double usualCost(double* costs, size_t count);

// Of vertices inside regions, on the boundary, and on interfaces.
struct RemovalCosts {
  struct Group {
    std::vector<Ways> sample;
    double vertices = 0;  // that it stands for
    // The same, but on a straight crease only along it; or none.
    std::vector<Ways> along_creases = {};
  };
  Group inside, outer, interfaces;
  // Of neighbours on the interface between two regions: how far each lies off the mean of those
  // round it, along the normal; how many pairs lie off by more than rounding leaves of a plane, and
  // sums of the squares and of the products.
  struct Jitter {
    size_t pairs = 0, off = 0;
    double square = 0, product = 0;
  };
  Jitter jitter;
  bool is_whole = false;  // nothing of the mesh is to come
  // What some of the boundary's vertices would add by going as far as they have free sight; of
  // walls of one cell only.
  std::vector<double> gaps;
  double touching = 0;     // of the boundary's vertices, that with another one at its place
  double least_field = 0;  // error of the fields, of all, that counts as none
};

// Whether next to none of a whole mesh lies inside, as in walls of one cell.
bool isWall(const RemovalCosts& costs);

// Chooses what is not known of sheets, where they and the inside have enough vertices and samples,
// for a mesh that is to keep this part of its vertices: 1 where less would gain nothing. Of few
// vertices too many are edges and corners. In walls of one cell the boundary counts less where it
// drowns the field, and where there is room for it.
constexpr double kLeastVertices = 256;
constexpr size_t kLeastPairs = 32;  // tell whether interfaces are rough
void chooseBalance(const RemovalCosts& costs, double ratio, Balance* balance);

}  // namespace tetstream
