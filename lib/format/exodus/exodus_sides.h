// format/exodus: labelled faces as sides of elements. Depends on grouped_rows.h, mesh_spool.h.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "grouped_rows.h"
#include "mesh_spool.h"

namespace tetstream {

// A side of an element, both from 1, as Exodus counts them.
struct ExodusSide {
  int32_t element, side;
};

// The sides that labelled faces are, by label. Of a face of two cells, that of the one out of which
// it looks as it is wound. Memory is bounded but for a bit a point.
class ExodusSides {
 public:
  // `elements`: of each cell, as int64 from 0. Faces whose label is no id are not looked at.
  ExodusSides(MeshSpool& mesh, RowSpool& elements, const std::string& temp_dir);

  const std::map<int64_t, uint64_t>& counts() const { return counts_; }  // by label
  RowSpool& rows() { return grouped_->rows(); }   // one label after the other
  uint64_t leftOut() const { return left_out_; }  // faces
  static bool isId(int64_t label) { return label > 0 && label <= INT32_MAX; }

 private:
  struct Found;
  void find(MeshSpool& mesh, RowSpool& elements, RowSpool& found);

  std::string temp_dir_;
  std::map<int64_t, uint64_t> counts_;
  uint64_t left_out_ = 0;
  std::unique_ptr<GroupedRows<ExodusSide>> grouped_;
};

}  // namespace tetstream
