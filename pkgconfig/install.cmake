# What `cmake --install` puts where: libraries, headers, and the descriptions by which pkg-config
# and CMake find them. Nothing installed names the build tree or the prefix: the tree can be moved.
include(CMakePackageConfigHelpers)

install(TARGETS tetstream EXPORT tetstreamTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
          NAMELINK_COMPONENT development)
install(TARGETS tetstream_static EXPORT tetstreamStaticTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/../include/tetstream
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.h")

# CMAKE_INSTALL_DOCDIR is that of the project of which this may be a part.
set(doc_dir ${CMAKE_INSTALL_DOCDIR})
if(NOT PROJECT_IS_TOP_LEVEL)
  set(doc_dir ${CMAKE_INSTALL_DATAROOTDIR}/doc/tetstream)
endif()
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/../tests/examples/
  DESTINATION ${doc_dir}/examples COMPONENT development
  FILES_MATCHING PATTERN "*.c" PATTERN "README.md")

# In no Debian package: these have it by another name.
install(FILES ${CMAKE_CURRENT_LIST_DIR}/../LICENSE DESTINATION ${doc_dir}
  COMPONENT license)

# A program in C that links the static library needs the compiler's C++ library, too.
set(cxx_runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM cxx_runtime ${CMAKE_C_IMPLICIT_LINK_LIBRARIES} m)
list(REMOVE_DUPLICATES cxx_runtime)
list(APPEND cxx_runtime m)
foreach(library IN LISTS cxx_runtime)
  target_link_libraries(tetstream_static INTERFACE $<INSTALL_INTERFACE:${library}>)
endforeach()

# -------------------------------------------------------------------------------- pkg-config
# The prefix is found from the place of the file itself, however deep the library folder is.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
  set(pc_libdir ${CMAKE_INSTALL_LIBDIR})
else()
  file(RELATIVE_PATH up /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
  string(REGEX REPLACE "/$" "" up ${up})
  set(pc_prefix "\${pcfiledir}/${up}")
  set(pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
endif()
if(IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(pc_includedir ${CMAKE_INSTALL_INCLUDEDIR})
else()
  set(pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
set(pc_requires "zlib expat")
set(TETSTREAM_CODECS "")  # those that pkg-config finds
foreach(codec IN LISTS TETSTREAM_LINKED)
  if(TETSTREAM_${codec})
    string(TOLOWER lib${codec} module)
    string(APPEND pc_requires " ${module}")
    list(APPEND TETSTREAM_CODECS ${codec})
  endif()
endforeach()
# Cairo and HDF5 are loaded, not linked: what that takes is the loader, where that is no part of the C library.
list(TRANSFORM CMAKE_DL_LIBS PREPEND " -l" OUTPUT_VARIABLE pc_dl)
list(TRANSFORM cxx_runtime PREPEND "-l")
list(JOIN cxx_runtime " " pc_cxx_runtime)
configure_file(${CMAKE_CURRENT_LIST_DIR}/tetstream.pc.in ${PROJECT_BINARY_DIR}/tetstream.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/tetstream.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(TETSTREAM_FORTRAN)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/tetstream-fortran.pc.in
    ${PROJECT_BINARY_DIR}/tetstream-fortran.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/tetstream-fortran.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT fortran)
endif()

# ------------------------------------------------------------------------------------- CMake
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tetstream)
foreach(export tetstreamTargets tetstreamStaticTargets)
  install(EXPORT ${export} NAMESPACE tetstream:: DESTINATION ${package_dir}
    COMPONENT development)
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tetstreamConfig.cmake.in
  ${PROJECT_BINARY_DIR}/tetstreamConfig.cmake INSTALL_DESTINATION ${package_dir})
# The ABI is not frozen before 1.0: until then only the same minor version will do.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatibility SameMinorVersion)
else()
  set(compatibility SameMajorVersion)
endif()
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tetstreamConfigVersion.cmake
  COMPATIBILITY ${compatibility})
if(TETSTREAM_FORTRAN)
  file(RELATIVE_PATH up /p/${package_dir} /p)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/tetstreamFortran.cmake.in
    ${PROJECT_BINARY_DIR}/tetstreamFortran.cmake @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/tetstreamFortran.cmake DESTINATION ${package_dir}
    COMPONENT fortran)
endif()
install(FILES ${PROJECT_BINARY_DIR}/tetstreamConfig.cmake
              ${PROJECT_BINARY_DIR}/tetstreamConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT development)
