// format/sv: tells which form an .sva file has without parsing its numbers. Depends on sv_open.h.
#pragma once

#include "sv_open.h"

namespace tetstream {

class SvaScanner final : public SvScanner {
 public:
  SvForm feed(const unsigned char* data, size_t size) override;
  SvForm end() override;

 private:
  enum class Place { kLineStart, kTag, kBlank, kReference, kRest };
  SvForm element(char tag);

  Place place_ = Place::kLineStart;
  char tag_ = 0;        // the line's first character
  int references_ = 0;  // of the line's cell, begun
  bool any_vertex_ = false, any_cell_ = false;
};

}  // namespace tetstream
