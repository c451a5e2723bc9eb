# Debian packages: `cpack -G DEB` in a build tree whose prefix is /usr. Each component that
# `cmake --install` knows is one package; what it is linked with is found by dpkg-shlibdeps, what it
# loads when it is needed is recommended.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tetstream)
set(CPACK_PACKAGE_VENDOR "tetstream")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/deb_files.cmake)
if(NOT CPACK_DEBIAN_PACKAGE_MAINTAINER)
  set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The tetstream authors <root@localhost>")
endif()

# What is loaded, not linked, by the package that owns it here.
set(loaded "")
if(TETSTREAM_HDF5)
  get_filename_component(file "${TETSTREAM_HDF5_FOUND}" REALPATH)
  list(APPEND loaded ${file})
endif()
if(TETSTREAM_CAIRO)
  foreach(library IN LISTS CAIRO_LINK_LIBRARIES)
    if(library MATCHES "/libcairo\\.")
      get_filename_component(file "${library}" REALPATH)
      list(APPEND loaded ${file})
    endif()
  endforeach()
endif()
find_program(DPKG_QUERY dpkg-query)
set(recommended "")
foreach(file IN LISTS loaded)
  if(DPKG_QUERY)
    execute_process(COMMAND ${DPKG_QUERY} -S ${file} OUTPUT_VARIABLE owner ERROR_QUIET)
    if(owner MATCHES "^([^:]+):")
      list(APPEND recommended ${CMAKE_MATCH_1})
    endif()
  endif()
endforeach()
list(JOIN recommended ", " recommended)

# deb_package(COMPONENT NAME SECTION SUMMARY TEXT)
macro(deb_package component name section summary text)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${text}")
endmacro()

string(CONCAT about
  "tetstream makes tetrahedral meshes smaller while they are read, following their\n"
  "fields, in memory that depends on the front of the stream and not on the size of\n"
  "the mesh.\n.\n")
set(CPACK_COMPONENTS_ALL "")
set(library_package libtetstream${TETSTREAM_SONAME})
deb_package(runtime ${library_package} libs "simplifies tetrahedral meshes (shared library)"
  "${about}This is the library that programs are linked with.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "${recommended}")
# What depends on it, and that the loader is to be told.
set(control ${PROJECT_BINARY_DIR}/packaging)
set(versions "${library_package} (>= ${PROJECT_VERSION})")
if(PROJECT_VERSION_MAJOR EQUAL 0)  # the ABI is not frozen
  math(EXPR next "${PROJECT_VERSION_MINOR} + 1")
  string(APPEND versions ", ${library_package} (<< 0.${next}~)")
endif()
file(WRITE ${control}/shlibs "libtetstream ${TETSTREAM_SONAME} ${versions}\n")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)

# What tetstream.pc and the static library ask for.
set(needed "${library_package} (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
string(APPEND needed ", zlib1g-dev, libexpat1-dev")
foreach(codec IN LISTS TETSTREAM_LINKED)
  if(TETSTREAM_${codec})
    string(TOLOWER "lib${codec}-dev" package)
    string(APPEND needed ", ${package}")
  endif()
endforeach()
deb_package(development libtetstream-dev libdevel
  "simplifies tetrahedral meshes (development files)"
  "${about}These are the header, the static library, the descriptions for pkg-config and CMake,\n\
and the manual.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${needed}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

if(TETSTREAM_BUILD_CLI)
  deb_package(tools tetstream science "simplifies tetrahedral meshes (command)"
    "${about}This is the command, with its manual and its completion in shells.")
  set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "${recommended}")
endif()

if(TETSTREAM_PYTHON)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  deb_package(python python3-tetstream python "simplifies tetrahedral meshes (Python 3)"
    "${about}This is the package for Python, on arrays of numpy.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python3_VERSION_MINOR}~), \
python3 (<< 3.${next}), python3-numpy (>= 1:${Python3_NumPy_VERSION})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "${recommended}")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-meshio")
  # As Debian's own packages: compiled when installed, and nothing of that is left when removed. Below
  # another root, whose Python this is not, nothing is done.
  set(here "[ -z \"$DPKG_ROOT\" ]")
  file(WRITE ${control}/python/postinst
    "#!/bin/sh\nset -e\nif ${here} && command -v py3compile >/dev/null; then py3compile -p python3-tetstream; fi\n")
  file(WRITE ${control}/python/prerm
    "#!/bin/sh\nset -e\nif ${here} && command -v py3clean >/dev/null; then py3clean -p python3-tetstream; fi\n")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${control}/python/postinst ${control}/python/prerm)
endif()

if(TETSTREAM_OCTAVE)
  # Modules are for one version's interface.
  string(REGEX MATCH "^[0-9]+" major "${octave_VERSION}")
  math(EXPR next "${major} + 1")
  deb_package(octave octave-tetstream science "simplifies tetrahedral meshes (Octave)"
    "${about}These are the functions for Octave.")
  set(CPACK_DEBIAN_OCTAVE_PACKAGE_DEPENDS "octave (>= ${major}), octave (<< ${next})")
  set(CPACK_DEBIAN_OCTAVE_PACKAGE_RECOMMENDS "${recommended}")
endif()

if(TETSTREAM_FORTRAN)
  deb_package(fortran libtetstream-fortran-dev libdevel "simplifies tetrahedral meshes (Fortran)"
    "${about}This is the module for Fortran: for gfortran, and its sources for other compilers.")
  set(CPACK_DEBIAN_FORTRAN_PACKAGE_DEPENDS
    "libtetstream-dev (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
  get_filename_component(folder ${TETSTREAM_FORTRAN_FOLDER} NAME)
  if(folder MATCHES "^gfortran-mod-")  # what gfortran's packages provide
    string(APPEND CPACK_DEBIAN_FORTRAN_PACKAGE_DEPENDS ", ${folder}")
  endif()
  set(CPACK_DEBIAN_FORTRAN_PACKAGE_SHLIBDEPS OFF)
endif()

include(CPack)
