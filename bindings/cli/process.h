// cli: what the command asks of the system: signals and the standard descriptors.
#pragma once

namespace tetstream::cli {

// First of all: descriptors 0 to 2 are open from here on, broken pipes are errors of write, SIGINT,
// SIGTERM and SIGHUP are counted (unless they were ignored: nohup), and large memory that is freed
// goes back to the system.
void prepareProcess();

// True after the first such signal; at another one that comes half a second later or more, the
// process ends at once.
bool interrupted();

// From here on a signal also makes pending and later transfers on that descriptor fail, so that a
// run does not wait for a pipe whose other end is silent.
void interruptTransfersOf(int standard_fd);

}  // namespace tetstream::cli
