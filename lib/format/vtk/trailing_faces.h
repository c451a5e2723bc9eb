// format/vtk: labelled faces on their way into a VTK file, where they are triangles after all
// tetrahedra. Depends on file_format.h, row_spool.h.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "face_label_column.h"
#include "file_format.h"
#include "row_spool.h"

namespace tetstream {

class TrailingFaces {
 public:
  struct Face {
    int64_t vertices[3], label;
  };

  TrailingFaces(const ByteSink& bytes, const WriteOptions& options)
      : name_(bytes.name()), options_(options) {}

  // Those of the batch wait for the last tetrahedron; so many vertices have come with it or before,
  // and throws for a face that names another. Where `cell_data` has an array with the name of their
  // labels faces are left out, and that is noted.
  void put(const BatchView& batch, uint64_t vertices, const std::vector<Column>& cell_data);
  // After the last.
  void close() {
    if (faces_) faces_->finish();
  }
  uint64_t count() const { return faces_ ? faces_->rows() : 0; }
  // Calls take(face) for each; closed.
  template <class Take>
  void forAll(Take take) {
    for (uint64_t i = 0; i < count(); ++i) {
      Face face;
      std::memcpy(&face, faces_->row(i), sizeof face);
      take(face);
    }
  }
  // Their labels, of which tetrahedra have 0.
  static Column labels() { return {kFaceLabelName, 1, ScalarType::kInt64}; }

 private:
  std::string name_;
  WriteOptions options_;
  std::unique_ptr<RowSpool> faces_;  // null: there are none
  bool noted_ = false;
};

// What only cells of the other kind have.
template <class Spool>
void appendZeros(Spool& spool, uint64_t bytes) {
  const std::vector<unsigned char> zeros(1024, 0);
  while (bytes > 0) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(bytes, zeros.size()));
    spool.append(zeros.data(), n);
    bytes -= n;
  }
}

}  // namespace tetstream
