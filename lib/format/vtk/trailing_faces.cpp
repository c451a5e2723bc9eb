#include "trailing_faces.h"

#include "status.h"

namespace tetstream {

static constexpr SpoolShape kInSequence = {1, 64 << 10};

void TrailingFaces::put(const BatchView& batch, uint64_t vertices,
                        const std::vector<Column>& cell_data) {
  if (batch.face_count == 0) return;
  if (findColumn(cell_data, kFaceLabelName) >= 0) {
    if (!noted_ && options_.note)
      options_.note(name_ + ": labelled faces are left out: the cell array \"" + kFaceLabelName +
                    "\", which would say their labels, is another");
    noted_ = true;
    return;
  }
  if (!faces_) faces_ = std::make_unique<RowSpool>(sizeof(Face), options_.temp_dir, kInSequence);
  for (size_t i = 0; i < batch.face_count; ++i) {
    const int64_t* v = batch.faces + 3 * i;
    for (int j = 0; j < 3; ++j)
      if (static_cast<uint64_t>(v[j]) >= vertices)
        fail(Status::kBadData, "%s: labelled face %llu names vertex %lld, but %llu have come",
             name_.c_str(), static_cast<unsigned long long>(faces_->rows()),
             static_cast<long long>(v[j]), static_cast<unsigned long long>(vertices));
    const Face face = {{v[0], v[1], v[2]}, batch.face_labels[i]};
    faces_->append(&face, 1);
  }
}

}  // namespace tetstream
