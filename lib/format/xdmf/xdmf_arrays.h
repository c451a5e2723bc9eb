// format/xdmf: the values that an XDMF file names, in its own text, in HDF5 files or in raw files
// beside it. Depends on xdmf_text.h, xdmf_slab.h, file_pool.h, mesh_pieces.h.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "file_pool.h"
#include "mesh_pieces.h"
#include "xdmf_slab.h"
#include "xdmf_text.h"

namespace tetstream {

class Hdf5File;

class XdmfArrays {
 public:
  XdmfArrays(std::shared_ptr<ByteSource> bytes, const XdmfText& text, const Helpers& helpers,
             const std::string& temp_dir)
      : bytes_(std::move(bytes)),
        text_(text),
        helpers_(helpers),
        pool_(std::make_shared<FilePool>(temp_dir)) {}

  // The item's values, which are as many as its sizes say: throws if they are not.
  MeshArray arrayOf(const XdmfItem& item, const std::string& name, int components);
  // What two items have alike if they are the same values.
  std::string placeOf(const XdmfItem& item);
  // Whether the items are as many and hold equal values, which are read for that.
  bool areEqual(const std::vector<XdmfItem>& a, const std::vector<XdmfItem>& b);
  std::string describe(const XdmfItem& item) const;  // "FILE: byte 7: the values", for messages

 private:
  bool areEqual(const XdmfItem& a, const XdmfItem& b);
  MeshArray ofText(const XdmfItem& item, MeshArray array);
  MeshArray ofHdf5(const XdmfItem& item, MeshArray array);
  MeshArray ofRawFile(const XdmfItem& item, MeshArray array);
  MeshArray ofSlab(const XdmfItem& item, MeshArray array);
  std::vector<SlabRange> rangesOf(const XdmfItem& item) const;
  ValueType typeOfRaw(const XdmfItem& item) const;

  std::shared_ptr<ByteSource> bytes_;
  const XdmfText text_;
  const Helpers helpers_;  // of text
  std::map<std::string, std::shared_ptr<Hdf5File>> files_;
  const std::shared_ptr<FilePool> pool_;
  std::map<std::string, std::shared_ptr<ByteSource>> raw_files_;
};

}  // namespace tetstream
