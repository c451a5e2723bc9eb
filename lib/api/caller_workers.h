// api: the caller's pool as Workers. Depends on tetstream.h, workers.h.
#pragma once

#include <memory>

#include "tetstream/tetstream.h"
#include "workers.h"

namespace tetstream {

// The table is copied. Throws kBadArgument, naming what is wrong with it.
std::shared_ptr<Workers> callerWorkers(const tetstream_pool_callbacks& callbacks);

}  // namespace tetstream
