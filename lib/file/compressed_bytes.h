// file: files in gzip's or zstd's wrapping. Depends on bytes.h.
#pragma once

#include <memory>
#include <string>

#include "bytes.h"

namespace tetstream {

enum class Wrapping { kNone, kGzip, kZstd };

// By the path's last extension, .gz or .zst; the path without it in *rest.
Wrapping wrappingOf(const std::string& path, std::string* rest);

// What is within, if the first bytes are those of a wrapping; else the source itself. What is
// unwrapped cannot be sought. Throws kUnsupported for zstd in a build without it.
std::unique_ptr<ByteSource> unwrapped(std::unique_ptr<ByteSource> bytes);
// Wraps what is written. commit() ends the wrapping.
std::unique_ptr<ByteSink> wrapped(std::unique_ptr<ByteSink> bytes, Wrapping wrapping);

}  // namespace tetstream
