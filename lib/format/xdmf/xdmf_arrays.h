// format/xdmf: the values that an XDMF file names, in its own text or in HDF5 files beside it.
// Depends on xdmf_tree.h, mesh_pieces.h.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "mesh_pieces.h"
#include "status.h"
#include "xdmf_tree.h"

namespace tetstream {

class Hdf5File;

class XdmfArrays {
 public:
  explicit XdmfArrays(std::shared_ptr<ByteSource> bytes) : bytes_(std::move(bytes)) {}

  // The item's values, which are as many as its sizes say: throws if they are not.
  MeshArray arrayOf(const XdmfItem& item, const std::string& name, int components);
  // What two items have alike if they are the same values.
  std::string placeOf(const XdmfItem& item);
  std::string describe(const XdmfItem& item) const;  // "FILE: byte 7: the values", for messages

 private:
  std::string textOfItem(const XdmfItem& item) const;
  MeshArray ofText(const XdmfItem& item, MeshArray array);
  MeshArray ofHdf5(const XdmfItem& item, MeshArray array);
  [[noreturn]] void failItem(const XdmfItem& item, Status status, const std::string& text) const;

  std::shared_ptr<ByteSource> bytes_;
  std::map<std::string, std::shared_ptr<Hdf5File>> files_;
};

}  // namespace tetstream
