# Plays a packager and then a user of the package. Stops at the first thing that does not work.
cmake_minimum_required(VERSION 3.25)

function(must)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    string(JOIN " " line ${ARGN})
    message(FATAL_ERROR "${line}\nfailed (${result}):\n${out}")
  endif()
endfunction()

set(here ${CMAKE_CURRENT_LIST_DIR})
file(REMOVE_RECURSE ${WORK})

# Installed to one place and moved to another: nothing in it may remember the first.
must(${CMAKE_COMMAND} --install ${BUILD} --prefix "${WORK}/first place")
file(RENAME "${WORK}/first place" "${WORK}/pre fix")
set(prefix "${WORK}/pre fix")
if(NOT EXISTS "${prefix}/${DOCDIR}/LICENSE")
  message(FATAL_ERROR "the licence is not installed")
endif()
file(GLOB_RECURSE texts "${prefix}/*.pc" "${prefix}/*.cmake")
list(LENGTH texts count)
if(count LESS 5)
  message(FATAL_ERROR "a .pc and four .cmake files at least should be there: ${texts}")
endif()
foreach(text IN LISTS texts)
  file(READ ${text} content)
  string(FIND "${content}" "${WORK}" in_work)
  string(FIND "${content}" "${BUILD}" in_build)
  if(NOT in_work EQUAL -1 OR NOT in_build EQUAL -1)
    message(FATAL_ERROR "${text} names a place of the build")
  endif()
endforeach()

# ------------------------------------------------------------------------------- pkg-config
# The shell takes the flags, as it does in a makefile.
if(PKG_CONFIG)
  set(ENV{PKG_CONFIG_PATH} "${prefix}/${LIBDIR}/pkgconfig")
  must(${PKG_CONFIG} --validate tetstream)
  must(${PKG_CONFIG} --exact-version=${VERSION} tetstream)
  foreach(client c cpp)
    set(compiler ${CC})
    if(client STREQUAL "cpp")
      set(compiler ${CXX})
    endif()
    must(sh -c "eval \"${compiler}\" '\"${here}/client.${client}\"' \
$(${PKG_CONFIG} --cflags --libs tetstream) -o '\"${WORK}/shared_${client}\"'")
    must(${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${prefix}/${LIBDIR}" ${WORK}/shared_${client})
    # Without the shared library in its way the linker takes the static one.
    must(sh -c "eval \"${compiler}\" '\"${here}/client.${client}\"' \
$(${PKG_CONFIG} --static --cflags --libs tetstream | sed 's/-ltetstream/-l:libtetstream.a/') \
-o '\"${WORK}/static_${client}\"'")
    must(${WORK}/static_${client})
  endforeach()
  if(FC)
    must(${PKG_CONFIG} --validate tetstream-fortran)
    foreach(linkage shared static)
      set(libraries "--libs tetstream-fortran")
      if(linkage STREQUAL "static")
        set(libraries "--static --libs tetstream-fortran | sed 's/-ltetstream /-l:libtetstream.a /'")
      endif()
      must(sh -c "eval \"${FC}\" '\"${here}/client.f90\"' \
$(${PKG_CONFIG} --cflags tetstream-fortran) $(${PKG_CONFIG} ${libraries}) \
-o '\"${WORK}/${linkage}_fortran\"'")
    endforeach()
    must(${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${prefix}/${LIBDIR}" ${WORK}/shared_fortran)
    must(${WORK}/static_fortran)
  endif()
  # The examples, as their README.md says it; those that need no arguments are run.
  set(examples "${prefix}/${DOCDIR}/examples")
  file(GLOB sources "${examples}/*.c" "${examples}/tutorial/*.c")
  list(LENGTH sources count)
  if(count LESS 14 OR NOT EXISTS "${examples}/README.md")
    message(FATAL_ERROR "examples are missing: ${sources}")
  endif()
  foreach(source IN LISTS sources)
    get_filename_component(name "${source}" NAME_WE)
    must(sh -c "eval \"${CC}\" '\"${source}\"' \
$(${PKG_CONFIG} --cflags --libs tetstream) -lm -o '\"${WORK}/example_${name}\"'")
  endforeach()
  foreach(name 02_arrays 03_options 08_errors)
    must(${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${prefix}/${LIBDIR}" ${WORK}/example_${name})
  endforeach()
else()
  message(STATUS "pkg-config is not here: its part was not run")
endif()

# ----------------------------------------------------------------------------------- Octave
# As tetstream-octave(3) says it for a prefix that is not Octave's own. (Python: python.wheel.)
if(OCTAVE)
  file(WRITE ${WORK}/client.m [=[
    [P, T] = tetstream_simplify ([eye(3); 0, 0, 0], 1:4, [], "ratio", 1);
    assert (rows (T), 1);
]=])
  must(${OCTAVE} --no-init-file --no-site-file --eval
    "addpath (genpath ('${prefix}/${DATADIR}/octave/site/m')), \
addpath (genpath ('${prefix}/${LIBDIR}/octave/site/oct')), run ('${WORK}/client.m')")
endif()

# ------------------------------------------------------------------------------------ CMake
foreach(linkage shared static any)
  must(${CMAKE_COMMAND} -S ${here}/project -B ${WORK}/${linkage} -G ${GENERATOR}
    -DCMAKE_C_COMPILER=${CC} -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_PREFIX_PATH=${prefix}"
    -DLINKAGE=${linkage})
  must(${CMAKE_COMMAND} --build ${WORK}/${linkage})
  must(${WORK}/${linkage}/client_c)
  must(${WORK}/${linkage}/client_cpp)
  if(FC AND NOT linkage STREQUAL "shared")  # which is what "any" means there
    set(build "${WORK}/${linkage} fortran")
    must(${CMAKE_COMMAND} -S ${here}/project_fortran -B "${build}" -G ${GENERATOR}
      -DCMAKE_Fortran_COMPILER=${FC} "-DCMAKE_PREFIX_PATH=${prefix}" -DLINKAGE=${linkage})
    must(${CMAKE_COMMAND} --build "${build}")
    must("${build}/client_fortran")
  endif()
endforeach()

# As a part of another project: nothing of that one's is changed, and the library alone is built.
must(${CMAKE_COMMAND} -S ${here}/parent -B ${WORK}/parent -G ${GENERATOR} -DTETSTREAM=${SOURCE}
  -DCMAKE_C_COMPILER=${CC} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON)
file(STRINGS ${WORK}/parent/tetstream/cmake_install.cmake docs REGEX "doc/parent")
if(docs)
  message(FATAL_ERROR "documents are installed among the other project's: ${docs}")
endif()

# Where it is told to be built with what is not there, or among its sources, it says so.
function(refuses text)
  execute_process(COMMAND ${CMAKE_COMMAND} ${ARGN} RESULT_VARIABLE result OUTPUT_QUIET
    ERROR_VARIABLE words)
  string(REGEX REPLACE "[ \n]+" " " words "${words}")
  string(FIND "${words}" "${text}" found)
  if(result EQUAL 0 OR found EQUAL -1)
    string(JOIN " " line ${ARGN})
    message(FATAL_ERROR "cmake ${line}\nshould fail with \"${text}\", not (${result}):\n${words}")
  endif()
endfunction()
refuses("there is no component Fortran of tetstream: there are shared, static and fortran"
  -S ${here}/project -B ${WORK}/unknown -G ${GENERATOR} -DCMAKE_C_COMPILER=${CC}
  -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_PREFIX_PATH=${prefix}" -DLINKAGE=Fortran)
refuses("TETSTREAM_ZSTD needs libzstd" -S ${SOURCE} -B ${WORK}/refused -G ${GENERATOR}
  -DCMAKE_C_COMPILER=${CC} -DCMAKE_CXX_COMPILER=${CXX} -DTETSTREAM_ZSTD=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
file(COPY ${SOURCE}/CMakeLists.txt DESTINATION ${WORK}/sources)
refuses("Build in a folder of its own" -S ${WORK}/sources -B ${WORK}/sources -G ${GENERATOR})

# A version that is not compatible is not found.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${here}/project -B ${WORK}/other -G ${GENERATOR}
  "-DCMAKE_PREFIX_PATH=${prefix}" -DLINKAGE=shared -DWANTED=0.0
  RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(result EQUAL 0)
  message(FATAL_ERROR "version 0.0 was asked for, and ${VERSION} taken")
endif()
file(REMOVE_RECURSE ${WORK})
