// Shared by the tests of rows that are read where they lie: binary MEDIT and Gmsh files of every
// version and byte order, with all that may come between such rows.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "indexed_testing.h"

namespace tetstream::test {

inline constexpr int kPlacedPoints = 60, kPlacedCells = 40;

class BinaryFile {
 public:
  explicit BinaryFile(bool swapped) : swapped_(swapped) {}
  void text(const std::string& text) { bytes.insert(bytes.end(), text.begin(), text.end()); }
  template <class Number>
  size_t put(Number value) {
    unsigned char at[sizeof value];
    std::memcpy(at, &value, sizeof value);
    if (swapped_) std::reverse(at, at + sizeof value);
    bytes.insert(bytes.end(), at, at + sizeof value);
    return bytes.size() - sizeof value;
  }
  // Over what is there.
  template <class Number>
  void putAt(size_t place, Number value) {
    const size_t end = bytes.size();
    put(value);
    std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end(),
              bytes.begin() + static_cast<std::ptrdiff_t>(place));
    bytes.resize(end);
  }
  // 4 or 8 bytes
  size_t integer(int64_t value, size_t width) {
    return width == 4 ? put(static_cast<int32_t>(value)) : put(value);
  }
  void real(double value, size_t width) {
    width == 4 ? put(static_cast<float>(value)) : put(value);
  }

  Bytes bytes;

 private:
  bool swapped_;
};

inline double coordinate(int point, int axis) {
  return 0.25 * ((point * 7 + axis * 11) % 29) - axis;
}

inline int64_t cornerOf(int cell, int k) {
  return (cell * 3 + k * 5) % kPlacedPoints;
}

// ------------------------------------------------------------------------------------------ MEDIT

struct MeditKind {
  int version;
  bool swapped, labelled;
};

class MeditFile : public BinaryFile {
 public:
  explicit MeditFile(const MeditKind& kind)
      : BinaryFile(kind.swapped),
        kind_(kind),
        integer_bytes_(kind.version == 4 ? 8 : 4),
        real_bytes_(kind.version == 1 ? 4 : 8),
        place_bytes_(kind.version >= 3 ? 8 : 4) {
    put<int32_t>(1);
    put<int32_t>(kind.version);
    begin(3);
    put<int32_t>(3);
  }
  void begin(int32_t keyword) {
    if (next_ > 0) {
      kind_.version >= 3 ? putAt(next_, static_cast<int64_t>(bytes.size()))
                         : putAt(next_, static_cast<int32_t>(bytes.size()));
    }
    put(keyword);
    next_ = integer(0, place_bytes_);
  }
  void rows(int64_t count) { integer(count, integer_bytes_); }
  void integer(int64_t value) { BinaryFile::integer(value, integer_bytes_); }
  using BinaryFile::integer;
  void real(double value) { BinaryFile::real(value, real_bytes_); }
  void vertices() {
    begin(4);
    rows(kPlacedPoints);
    for (int i = 0; i < kPlacedPoints; ++i) {
      for (int k = 0; k < 3; ++k) real(coordinate(i, k));
      integer(kind_.labelled && i > 40 ? i : 0);
    }
  }
  // Cells of so many points; the labels are 0 up to the last ones.
  void cells(int32_t keyword, int count, int points, int first = 0) {
    begin(keyword);
    rows(count);
    for (int i = first; i < first + count; ++i) {
      for (int k = 0; k < points; ++k) integer(1 + cornerOf(i, k));
      integer(kind_.labelled && i >= 30 ? i : 0);
    }
  }
  void solution(int32_t keyword, int count) {
    begin(keyword);
    rows(count);
    put<int32_t>(2);
    put<int32_t>(2);
    put<int32_t>(1);
    for (int i = 0; i < 4 * count; ++i) real(0.5 * i);
  }
  Bytes end() {
    begin(54);
    return bytes;
  }

 private:
  MeditKind kind_;
  size_t integer_bytes_, real_bytes_, place_bytes_, next_ = 0;
};

inline Bytes wholeMedit(const MeditKind& kind) {
  MeditFile file(kind);
  file.cells(6, 1, 3);
  file.vertices();
  file.cells(8, kPlacedCells - 10, 4);
  file.begin(5);  // edges, which are passed over
  file.rows(1);
  for (int i = 0; i < 3; ++i) file.integer(1);
  file.cells(10, 2, 8, 3);
  file.cells(30, 10, 10, kPlacedCells - 10);
  file.cells(6, 2, 3, 35);
  file.solution(62, kPlacedPoints);
  return file.end();
}

// ------------------------------------------------------------------------------------------- Gmsh

// Tags of points are runs, those of elements count on.
inline int64_t tagOf(int64_t point) {
  return point < 20 ? 500 + point : 100 + point;
}

class MshFile : public BinaryFile {
 public:
  MshFile(const char* version, bool swapped) : BinaryFile(swapped), is_4_(version[0] == '4') {
    text(std::string("$MeshFormat\n") + version + " 1 8\n");
    put<int32_t>(1);
    text("\n$EndMeshFormat\n");
  }
  void comments(const std::string& text) { this->text("$Comments\n" + text + "\n$EndComments\n"); }
  void entities() {
    text("$Entities\n");
    for (int64_t count : {0, 0, 1, 2}) put(count);
    for (int32_t entity : {4, 1, 2}) {
      put(entity);
      for (int k = 0; k < 6; ++k) put(0.0);
      put(int64_t{entity == 1 ? 0 : 1});
      if (entity != 1) put<int32_t>(entity + 30);
      put<int64_t>(0);
    }
    text("\n$EndEntities\n");
  }
  void nodes() {
    text(is_4_ ? "$Nodes\n" : "$Nodes\n" + std::to_string(kPlacedPoints) + "\n");
    if (is_4_) {
      for (int64_t count : {2, kPlacedPoints, 1, 999}) put(count);
      nodeBlock(0, 20, 2, true);
      nodeBlock(20, kPlacedPoints, 3, false);
    }
    for (int i = 0; i < kPlacedPoints && !is_4_; ++i) {
      put(static_cast<int32_t>(tagOf(i)));
      position(i);
    }
    text("\n$EndNodes\n");
  }
  void elements() {
    text(is_4_ ? "$Elements\n" : "$Elements\n" + std::to_string(kPlacedCells + 2) + "\n");
    if (is_4_)
      for (int64_t count : {4, kPlacedCells + 2, 1, 999}) put(count);
    block({2, 4, 2, 2, 3}, 0, 2);
    block({3, 1, 4, 2, 4}, 0, 20);
    block({3, 2, 11, 3, 10}, 20, 10);
    block({3, 2, 4, 2, 4}, 30, 10);
    text("\n$EndElements\n");
  }
  struct Data {
    const char* section;
    const char* name;
    int rows, components;
  };
  // Of tag(row)
  template <class Tag>
  void data(const Data& d, Tag tag) {
    text(std::string("$") + d.section + "\n1\n\"" + d.name + "\"\n1\n0\n3\n0\n" +
         std::to_string(d.components) + "\n" + std::to_string(d.rows) + "\n");
    for (int i = 0; i < d.rows; ++i) {
      put(static_cast<int32_t>(tag(i)));
      for (int k = 0; k < d.components; ++k) put(1.5 * i + k);
    }
    text(std::string("\n$End") + d.section + "\n");
  }
  size_t last_row = 0;  // where the last element begins

 private:
  struct Block {
    int32_t dimension, entity, kind;
    int tags, points;  // tags: of version 2
  };
  void position(int point) {
    for (int k = 0; k < 3; ++k) put(coordinate(point, k));
  }
  void nodeBlock(int begin, int end, int32_t dimension, bool parametric) {
    for (int32_t value : {dimension, 1, parametric ? 1 : 0}) put(value);
    put<int64_t>(end - begin);
    for (int i = begin; i < end; ++i) put(tagOf(i));
    for (int i = begin; i < end; ++i) {
      position(i);
      for (int k = 0; k < dimension && parametric; ++k) put(9.0);
    }
  }
  void block(const Block& b, int first, int count) {
    if (is_4_) {
      for (int32_t value : {b.dimension, b.entity, b.kind}) put(value);
      put<int64_t>(count);
    } else {
      for (int32_t value : {b.kind, count, b.tags}) put(value);
    }
    const size_t width = is_4_ ? 8 : 4;
    for (int i = first; i < first + count; ++i) {
      last_row = integer(b.dimension == 2 ? 900 + i : 300 + i, width);
      for (int k = 0; k < b.tags && !is_4_; ++k)
        integer(k == 0 ? (b.entity == 1 ? 0 : b.entity + 30) : b.entity, width);
      for (int k = 0; k < b.points; ++k) integer(tagOf(cornerOf(i, k)), width);
    }
  }
  bool is_4_;
};

inline Bytes wholeMsh(const char* version, bool swapped) {
  MshFile file(version, swapped);
  file.comments("tetstream position float32\ntetstream field float32 narrow");
  if (version[0] == '4') file.entities();
  file.nodes();
  file.elements();
  file.data({"NodeData", "in order", kPlacedPoints, 1}, [](int i) { return tagOf(i); });
  file.data({"NodeData", "narrow", kPlacedPoints, 3}, [](int i) { return tagOf(i); });
  file.data({"NodeData", "reversed", kPlacedPoints, 1},
            [](int i) { return tagOf(kPlacedPoints - 1 - i); });
  file.data({"NodeData", "some", 7, 1}, [](int i) { return tagOf(3 * i); });
  file.data({"ElementData", "of cells", kPlacedCells, 2}, [](int i) { return 300 + i; });
  file.data({"ElementData", "of faces, too", kPlacedCells + 2, 1},
            [](int i) { return i < 2 ? 900 + i : 298 + i; });
  // A second part of what had all rows.
  file.data({"NodeData", "in order", 2, 1}, [](int i) { return tagOf(7 + i); });
  return file.bytes;
}

}  // namespace tetstream::test
