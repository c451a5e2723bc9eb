// file: base64 text, as XML files hold binary data. Depends on nothing.
#pragma once

#include <cstddef>

namespace tetstream {

// Decodes groups of four characters to three bytes each until `groups` are done, a group is padded
// with '=' (which ends a text) or a group is no base64. Returns the bytes written, at most three
// per group; *used is the number of groups decoded, the padded one included.
size_t decodeBase64(const char* text, size_t groups, unsigned char* out, size_t* used);

}  // namespace tetstream
