#include "sva_scan.h"

#include <cstring>

namespace tetstream {

// What a line says as soon as its tag and the blank after it are read.
SvForm SvaScanner::element(char tag) {
  if (tag == 'x') return any_cell_ && !any_vertex_ ? SvForm::kPostOrder : SvForm::kPreOrder;
  if (tag == 'c') {
    if (!any_vertex_) return SvForm::kPostOrder;
    any_cell_ = true;
  } else {
    if (any_cell_) return SvForm::kPreOrder;
    any_vertex_ = true;
  }
  return SvForm::kUndecided;
}

SvForm SvaScanner::feed(const unsigned char* data, size_t size) {
  const char* at = reinterpret_cast<const char*>(data);
  const char* end = at + size;
  while (at < end) {
    if (place_ == Place::kRest) {
      at = static_cast<const char*>(std::memchr(at, '\n', static_cast<size_t>(end - at)));
      if (!at) return SvForm::kUndecided;
    }
    const char c = *at++;
    if (c == '\n') {
      place_ = Place::kLineStart;
    } else if (place_ == Place::kLineStart) {
      tag_ = c;
      place_ = c == 'v' || c == 'c' || c == 'x' ? Place::kTag : Place::kRest;
    } else if (place_ == Place::kTag) {
      place_ = c == ' ' && tag_ == 'c' ? Place::kBlank : Place::kRest;
      references_ = 0;
      if (c != ' ') continue;
      const SvForm form = element(tag_);
      if (form != SvForm::kUndecided) return form;
    } else if (c == ' ' || c == '\t') {
      place_ = references_ < 4 ? Place::kBlank : Place::kRest;
    } else if (place_ == Place::kBlank) {
      if (c == '-') return SvForm::kPreOrder;  // a last use
      place_ = Place::kReference;
      ++references_;
    }
  }
  return SvForm::kUndecided;
}

SvForm SvaScanner::end() {
  return any_cell_ ? SvForm::kIndexed : SvForm::kPreOrder;
}

}  // namespace tetstream
