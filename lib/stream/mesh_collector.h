// stream: an indexed mesh that comes in batches, put together. Depends on memory_source.h.
#pragma once

#include <memory>

#include "memory_source.h"

namespace tetstream {

// Keeps all of it in memory. Finalizations are dropped: an indexed mesh has none.
class MeshCollector {
 public:
  explicit MeshCollector(const Schema& schema);
  void put(const BatchView& batch);
  // The mesh so far; borrows this object, to which nothing may then be added.
  std::unique_ptr<IndexedSource> source();

 private:
  Schema schema_;
  Batch mesh_;
};

}  // namespace tetstream
