#include "hdf5_driver.h"

#ifdef TETSTREAM_WITH_HDF5
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include <cstring>
#include <new>

#include "status.h"

namespace tetstream {

namespace {

struct DriverInfo {
  const std::shared_ptr<Hdf5Link>* link;
};

struct DriverFile {
  H5FD_t library_part;  // first
  std::shared_ptr<Hdf5Link> link;
  haddr_t end_of_addresses;
};

DriverFile& own(H5FD_t* file) {
  return *reinterpret_cast<DriverFile*>(file);
}
const DriverFile& own(const H5FD_t* file) {
  return *reinterpret_cast<const DriverFile*>(file);
}

// No exception passes through the library, which is C: the file keeps it.
template <class Function>
bool kept(H5FD_t* file, Function function) noexcept {
  Hdf5File* const known = own(file).link->file;
  if (!known) return false;
  try {
    function(known->storage());
    return true;
  } catch (...) {
    known->keepError();
    return false;
  }
}

H5FD_t* openDriver(const char*, unsigned, hid_t access, haddr_t) {
  const void* info = hdf5().Pget_driver_info(access);
  auto* opened = info ? new (std::nothrow) DriverFile{} : nullptr;
  if (!opened) return nullptr;
  opened->link = *static_cast<const DriverInfo*>(info)->link;
  return &opened->library_part;
}

herr_t closeDriver(H5FD_t* file) {
  delete &own(file);
  return 0;
}

herr_t queryDriver(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t endOfAddresses(const H5FD_t* file, H5FD_mem_t) {
  return own(file).end_of_addresses;
}

herr_t setEndOfAddresses(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  own(file).end_of_addresses = end;
  return 0;
}

haddr_t endOfFile(const H5FD_t* file, H5FD_mem_t) {
  const Hdf5File* const known = own(file).link->file;
  return known ? known->storage().size() : own(file).end_of_addresses;
}

// What lies between the file's end and that of the addresses was never written.
herr_t readDriver(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* out) {
  const bool good = kept(file, [&](Hdf5Storage& storage) {
    const size_t got = storage.readAt(address, out, size);
    std::memset(static_cast<char*>(out) + got, 0, size - got);
  });
  return good ? 0 : -1;
}

// note: a failure is not told to the library, whose state is broken, up to a crash when the program
// ends, once a file could not be closed. Our file is the one that knows, and fails.
herr_t writeDriver(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size,
                   const void* data) {
  kept(file, [&](Hdf5Storage& storage) { storage.writeAt(address, data, size); });
  return 0;
}

herr_t truncateDriver(H5FD_t* file, hid_t, hbool_t) {
  kept(file, [&](Hdf5Storage& storage) {
    if (storage.size() != own(file).end_of_addresses) storage.resize(own(file).end_of_addresses);
  });
  return 0;
}

hid_t registerDriver() {
  static H5FD_class_t driver;
#if H5_VERSION_GE(1, 13, 0)
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(H5FD_CLASS_VALUE_RESERVED_END + 1);
#endif
  driver.name = "tetstream";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = openDriver;
  driver.close = closeDriver;
  driver.query = queryDriver;
  driver.get_eoa = endOfAddresses;
  driver.set_eoa = setEndOfAddresses;
  driver.get_eof = endOfFile;
  driver.read = readDriver;
  driver.write = writeDriver;
  driver.truncate = truncateDriver;
  const H5FD_mem_t map[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::memcpy(driver.fl_map, map, sizeof map);
  return hdf5().FDregister(&driver);
}

}  // namespace

Hdf5Id hdf5AccessOf(Hdf5File& file) {
  static const hid_t driver = registerDriver();
  Hdf5Id access(hdf5().Pcreate(hdf5().P_CLS_FILE_ACCESS_ID), hdf5().Pclose);
  const DriverInfo info = {&file.link()};
  if (driver < 0 || access < 0 || hdf5().Pset_driver(access, driver, &info) < 0 ||
      hdf5().Pset_fclose_degree(access, H5F_CLOSE_STRONG) < 0)
    fail(Status::kInternal, "%s: HDF5 refuses our way to the file", file.name().c_str());
  return access;
}

}  // namespace tetstream
#endif
