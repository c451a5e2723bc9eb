// layout: a stream taken apart again, as an indexed mesh in temporary files. Depends on
// mesh_reading.h, row_spool.h.
#pragma once

#include "memory.h"
#include "mesh_reading.h"
#include "row_spool.h"

namespace tetstream {

// Reads the stream to its end when made. Streams with labelled boundary faces are kUnsupported.
class SpooledMesh : public IndexedSource {
 public:
  SpooledMesh(Source& source, const std::string& temp_dir, const Tell& tell);
  const Schema& schema() const override { return schema_; }
  const uint8_t* locked() const override { return any_locked_ ? locked_.data() : nullptr; }
  void readPositions(uint64_t first, size_t count, void* out) override;
  void readField(size_t column, uint64_t first, size_t count, void* out) override;
  void readCells(uint64_t first, size_t count, int64_t* out) override;
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override;

  uint64_t diskBytes() const;

 private:
  void take(const BatchView& batch);
  void makeRoomForLocks(size_t vertices);

  Schema schema_;
  Account account_;
  RowSpool positions_, cells_;
  std::vector<std::unique_ptr<RowSpool>> fields_, cell_data_;
  Array<uint8_t> locked_;  // per vertex so far
  bool any_locked_ = false;
};

}  // namespace tetstream
