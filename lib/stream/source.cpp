#include "source.h"

namespace tetstream {

void copyStream(Source& source, Sink& sink) {
  sink.begin(source.schema());
  BatchView batch;
  while (source.next(batch)) sink.put(batch);
  sink.finish();
}

}  // namespace tetstream
