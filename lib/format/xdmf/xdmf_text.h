// format/xdmf: the short texts of DataItems: names of files and of datasets, paths to other items,
// the numbers of a hyperslab. Depends on xdmf_tree.h.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "status.h"
#include "xdmf_tree.h"

namespace tetstream {

class XdmfText {
 public:
  // `entities`: what the file declares, by name.
  XdmfText(std::shared_ptr<ByteSource> bytes, std::map<std::string, std::string> entities)
      : bytes_(std::move(bytes)), entities_(std::move(entities)) {}

  // Without the blanks around it, with what its entities stand for.
  std::string of(const XdmfItem& item) const;
  std::string placeOf(const XdmfItem& item) const;  // "FILE: byte 7", for messages
  [[noreturn]] void failItem(const XdmfItem& item, Status status, const std::string& text) const;

 private:
  std::string withoutEntities(const XdmfItem& item, const std::string& text) const;
  std::string meaningOf(const XdmfItem& item, const std::string& entity) const;

  std::shared_ptr<ByteSource> bytes_;
  std::map<std::string, std::string> entities_;
};

}  // namespace tetstream
