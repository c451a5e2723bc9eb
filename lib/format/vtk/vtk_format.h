// format/vtk: VTK's files, as rows of the table of formats. Depends on file_format.h.
#pragma once

#include <memory>

#include "file_format.h"

namespace tetstream {

Input openVtu(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
Input openPvtu(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
Input openPvd(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
Input openVtk(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
Input openVtkHdf(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
std::unique_ptr<Sink> createVtu(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);
std::unique_ptr<Sink> createVtk(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);
std::unique_ptr<Sink> createVtkHdf(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);

}  // namespace tetstream
