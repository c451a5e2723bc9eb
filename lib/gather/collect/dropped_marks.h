// gather/collect: what a format of points and cells cannot hold of a stream, told once each.
// Depends on file_format.h.
#pragma once

#include "file_format.h"

namespace tetstream {

class DroppedMarks {
 public:
  // `format` is named in the notes, which begin with the output's name.
  DroppedMarks(const ByteSink& bytes, const WriteOptions& options, const char* format)
      : note_(options.note), name_(bytes.name()), format_(format) {}
  void look(const BatchView& batch);  // locks and faces
  void lookAtLocks(const BatchView& batch);
  void lookAtLockedFaces(const BatchView& batch);  // and edges

 private:
  void tell(bool* told, const std::string& text);

  std::function<void(const std::string&)> note_;
  std::string name_;
  const char* format_;
  bool told_vertices_ = false, told_locks_ = false, told_faces_ = false;
};

}  // namespace tetstream
