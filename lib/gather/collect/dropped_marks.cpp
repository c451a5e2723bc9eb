#include "dropped_marks.h"

#include <algorithm>

namespace tetstream {

static bool any(const uint8_t* locks, size_t count) {
  return locks && std::any_of(locks, locks + count, [](uint8_t lock) { return lock != 0; });
}

void DroppedMarks::tell(bool* told, const std::string& text) {
  if (!*told && note_) note_(name_ + ": " + text);
  *told = true;
}

void DroppedMarks::lookAtLocks(const BatchView& batch) {
  if (batch.edge_count > 0 || any(batch.locked, batch.vertex_count) ||
      any(batch.face_locks, batch.face_count))
    tell(&told_locks_, std::string("locks of vertices, edges and faces are left out: ") + format_ +
                           " has no place for them");
}

void DroppedMarks::look(const BatchView& batch) {
  lookAtLocks(batch);
  if (batch.face_count > 0)
    tell(&told_faces_, "the labels of boundary faces are left out: they are no tetrahedra");
}

}  // namespace tetstream
