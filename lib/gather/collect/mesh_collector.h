// gather/collect: what the writers of files share that cannot be written as a stream: all is
// collected in temporary files, then written. Depends on mesh_spool.h, dropped_marks.h,
// file_format.h.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "dropped_marks.h"
#include "file_format.h"
#include "mesh_spool.h"
#include "rows_at_once.h"

namespace tetstream {

class MeshCollector : public Sink {
 public:
  // `format` as for DroppedMarks.
  MeshCollector(std::unique_ptr<ByteSink> bytes, const WriteOptions& options, const char* format)
      : bytes_(std::move(bytes)), options_(options), dropped_(*bytes_, options, format) {}

  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override;
  void finish() override;

 protected:
  // The mesh is complete. Everything but the commit.
  virtual void write(MeshSpool& mesh) = 0;
  virtual bool holdsLocks() const { return false; }  // of points

  void note(const std::string& text) const;
  void noteRounded(const std::string& array) const;  // to float64
  ByteSink& bytes() { return *bytes_; }
  const WriteOptions& options() const { return options_; }

 private:
  std::unique_ptr<ByteSink> bytes_;
  WriteOptions options_;
  DroppedMarks dropped_;
  std::unique_ptr<MeshSpool> mesh_;
};

// visit(row, pointer to it) for all rows of what read(first, count, out) reads, in order.
template <class Read, class Visit>
void forEachRow(uint64_t rows, size_t row_bytes, Read read, Visit visit) {
  std::vector<unsigned char> held(kRowsAtOnce * row_bytes);
  for (uint64_t first = 0; first < rows; first += kRowsAtOnce) {
    const auto n = static_cast<size_t>(rows - first < kRowsAtOnce ? rows - first : kRowsAtOnce);
    read(first, n, held.data());
    for (size_t i = 0; i < n; ++i)
      visit(first + i, static_cast<const unsigned char*>(held.data()) + i * row_bytes);
  }
}

}  // namespace tetstream
