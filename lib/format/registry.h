// format: the table of file formats, one row per format, each in a room of its own. Depends on
// file_format.h.
#pragma once

#include "file_format.h"

namespace tetstream {

const Format* formats(size_t* count);
const Format* findFormat(const std::string& name);  // null: no such format
// By extension, after which .gz or .zst may follow; null: unknown.
const Format* formatOfPath(const std::string& path);
// As above, but throw kUnsupported with a sentence that lists what there is, for that use. `name`
// may be empty: then the path's extension decides.
enum class FormatUse { kReading, kWriting };
const Format& needFormat(const std::string& name, const std::string& path,
                         FormatUse use = FormatUse::kReading);

}  // namespace tetstream
