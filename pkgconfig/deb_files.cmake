# Runs in cpack, on the folders that are going to be packages: adds to each its licence, and packs the
# pages of the manual, as Debian has them.
cmake_minimum_required(VERSION 3.25)
find_program(gzip gzip REQUIRED)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  if(NOT IS_DIRECTORY ${root})
    continue()
  endif()
  configure_file(${CMAKE_CURRENT_LIST_DIR}/../LICENSE
    ${root}/share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}/copyright COPYONLY)
  file(GLOB_RECURSE pages ${root}/share/man/*.[1-9])
  if(pages)
    execute_process(COMMAND ${gzip} -n9 ${pages} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
