#include "dropped_marks.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

static bool any(const uint8_t* locks, size_t count) {
  return locks && std::any_of(locks, locks + count, [](uint8_t lock) { return lock != 0; });
}

void DroppedMarks::tell(bool* told, const std::string& text) {
  if (!*told && note_) note_(name_ + ": " + text);
  *told = true;
}

void DroppedMarks::lookAtLocks(const BatchView& batch) {
  if (!told_vertices_ && any(batch.locked, batch.vertex_count))
    tell(&told_vertices_,
         textOf("locks of vertices are left out: %s has no place for them", format_));
  lookAtLockedFaces(batch);
}

void DroppedMarks::lookAtLockedFaces(const BatchView& batch) {
  if (!told_locks_ && (batch.edge_count > 0 || any(batch.face_locks, batch.face_count)))
    tell(&told_locks_,
         textOf("locks of edges and faces are left out: %s has no place for them", format_));
}

void DroppedMarks::look(const BatchView& batch) {
  lookAtLocks(batch);
  if (batch.face_count > 0)
    tell(&told_faces_, "the labels of boundary faces are left out: they are no tetrahedra");
}

}  // namespace tetstream
