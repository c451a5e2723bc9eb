// cli: the library's handles with owners. Depends on the public header.
#pragma once

#include <tetstream/tetstream.h>

#include <memory>

namespace tetstream::cli {

struct Destroy {
  void operator()(tetstream_options* handle) const { tetstream_options_destroy(handle); }
  void operator()(tetstream_reader* handle) const { tetstream_reader_destroy(handle); }
  void operator()(tetstream_writer* handle) const { tetstream_writer_destroy(handle); }
  void operator()(tetstream_simplifier* handle) const { tetstream_simplifier_destroy(handle); }
  void operator()(tetstream_diagram* handle) const { tetstream_diagram_destroy(handle); }
  void operator()(tetstream_comparison* handle) const { tetstream_comparison_destroy(handle); }
};
using Options = std::unique_ptr<tetstream_options, Destroy>;
using Reader = std::unique_ptr<tetstream_reader, Destroy>;
using Writer = std::unique_ptr<tetstream_writer, Destroy>;
using Simplifier = std::unique_ptr<tetstream_simplifier, Destroy>;
using Diagram = std::unique_ptr<tetstream_diagram, Destroy>;
using Comparison = std::unique_ptr<tetstream_comparison, Destroy>;

}  // namespace tetstream::cli
