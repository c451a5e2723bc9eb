// stream: what the events of a mesh stream carry. Depends on base.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scalar.h"

namespace tetstream {

constexpr int kMaxComponents = 9;  // of one column: a scalar, a vector, ... a 3x3 tensor

constexpr size_t kMostNameBytes = 255;  // of an array's or a label's name

// The text, cut to so many, but not in the middle of a UTF-8 character.
std::string cutName(const std::string& text, size_t most = kMostNameBytes);

// A named array: a field (one row per vertex) or cell data (one row per cell). Float fields are
// interpolated, float cell data averaged by volume; integers are picked, never averaged.
struct Column {
  std::string name;
  int components = 1;
  ScalarType type = ScalarType::kFloat32;
  size_t bytesPerRow() const { return static_cast<size_t>(components) * sizeOf(type); }
};

// What a label means to people: a region or a part of the boundary. Labels are what counts; names
// go with them from file to file.
struct LabelName {
  std::string array;  // of integers, one to a cell, whose label it is; empty: labelled faces'
  int64_t label = 0;
  std::string name;
  bool operator==(const LabelName&) const = default;
};

struct Schema {
  ScalarType position_type = ScalarType::kFloat32;  // a float type
  std::vector<Column> fields;
  std::vector<Column> cell_data;
  std::vector<LabelName> label_names;  // of some labels; sorted, see label_names.h
  std::optional<double> time;          // of the values, where the file tells it

  // What is known beforehand; -1 or empty where it is not.
  int64_t vertex_count = -1;
  int64_t cell_count = -1;
  int64_t face_count = -1;   // labelled faces
  int64_t front_width = -1;  // vertices active at once, at most
  int64_t front_span = -1;   // highest minus lowest active vertex + 1, at most
  int64_t front_cells = -1;  // cells read that touch a vertex not yet finalized, at most
  // x y z, then every component of every field in order: bounds of the values that are finite; inf
  // and -inf of a component that has none.
  std::vector<double> box_min, box_max;

  size_t fieldComponents() const;  // of all fields together
  size_t boxSize() const { return 3 + fieldComponents(); }
  bool hasBox() const { return box_min.size() == boxSize() && box_max.size() == boxSize(); }
};

// Throws kBadArgument, naming the column: names empty, repeated or longer than 255 bytes,
// components outside 1..9, unknown types, positions that are not floats; the same of labels' names,
// and those of no such array and of a label that has one; a time that is not finite.
void checkSchema(const Schema& schema);

// Of "point 7": one of its values of a measured field is not finite.
[[noreturn]] void failNotFinite(const std::string& row, const Column& field);

// Index of the column of that name, or -1.
int findColumn(const std::vector<Column>& columns, const std::string& name);
// Whether a cell array of this name tells which process had a cell, or whose copy it is, as
// parallel programs write it: where such parts meet is nothing of the domain's.
bool namesPartition(const std::string& name);

}  // namespace tetstream
