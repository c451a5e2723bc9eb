/* The public header stands on its own, twice, and gives C linkage. */
#include "tetstream/tetstream.h"

const char* (*name_of)(tetstream_status) = tetstream_status_name;
