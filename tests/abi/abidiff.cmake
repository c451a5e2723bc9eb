# Compares the ABI that the header declares with the stored one (lib/abi/tetstream.abi), by abidw and
# abidiff on a library of empty functions: abi.symbols sees to it that the real one exports the same,
# and the compiler that it declares them so. Then proves on altered headers what is caught.
#   cmake -D UPDATE=ON ... writes the stored one anew.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${WORK})

# describe(NAME HEADER-TEXT MAP-TEXT): a library with debug information, and WORK/NAME.abi.
function(describe name header map)
  set(folder ${WORK}/${name})
  file(MAKE_DIRECTORY ${folder}/tetstream)
  file(WRITE ${folder}/tetstream/tetstream.h "${header}")
  configure_file(${INCLUDE}/tetstream/version.h ${folder}/tetstream/version.h COPYONLY)
  file(WRITE ${folder}/map "${map}")
  # The same declarations once more, with bodies.
  string(REGEX REPLACE "/\\*[^*]*\\*+([^/*][^*]*\\*+)*/" "" bare "${header}")
  string(REPLACE ";" "@" bare "${bare}")
  string(REGEX MATCHALL "TETSTREAM_API [a-z][^@]*@" declarations "${bare}")
  set(code "#include <tetstream/tetstream.h>\n")
  foreach(declaration IN LISTS declarations)
    string(REPLACE "@" " { __builtin_trap(); }\n" definition "${declaration}")
    string(APPEND code "${definition}")
  endforeach()
  file(WRITE ${folder}/empty.c "${code}")
  execute_process(COMMAND ${CC} -g -O0 -w -shared -fPIC -I. -Wl,--version-script=map
    -Wl,-soname,libtetstream.so empty.c -o libtetstream.so
    WORKING_DIRECTORY ${folder} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${ABIDW} --no-show-locs --no-corpus-path --no-comp-dir-path
    --headers-dir tetstream --out-file ../${name}.abi libtetstream.so
    WORKING_DIRECTORY ${folder} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Structs that begin with their size may grow at their ends: what an older program hands over says how
# much of one it knows. Takes what abidiff says of such growth out of its words.
function(forgive_growth words out)
  string(REGEX MATCHALL "typedef struct tetstream_[a-z_]+ {\n *size_t struct_size" sized "${header}")
  foreach(begin IN LISTS sized)
    string(REGEX REPLACE "typedef struct (tetstream_[a-z_]+).*" "\\1" name "${begin}")
    set(block "'struct ${name}' changed:\n  type size changed from ([0-9]+) to [0-9]+ .in bits.\n")
    string(APPEND block "  [0-9]+ data member insertions?:\n(    '[^\n]*', at offset [0-9]+ .in bits.\n)+")
    if(NOT words MATCHES "${block}")
      continue()
    endif()
    set(said "${CMAKE_MATCH_0}")
    set(size ${CMAKE_MATCH_1})
    set(is_growth TRUE)
    string(REGEX MATCHALL "at offset [0-9]+" offsets "${said}")
    foreach(offset IN LISTS offsets)
      string(REGEX REPLACE "at offset " "" offset "${offset}")
      if(offset LESS size)
        set(is_growth FALSE)
      endif()
    endforeach()
    if(is_growth)
      string(REPLACE "${said}" "" words "${words}")
    endif()
  endforeach()
  set(${out} "${words}" PARENT_SCOPE)
endfunction()

# Sets `out` to what abidiff has to say about an older and a newer ABI: empty if the newer will do.
function(compare older newer out)
  execute_process(COMMAND ${ABIDIFF} --no-added-syms --leaf-changes-only ${older} ${newer}
    RESULT_VARIABLE result OUTPUT_VARIABLE words ERROR_VARIABLE words)
  forgive_growth("${words}\n" words)
  # It ends with 4 for any change, with 8 also for what is surely one, with 1 and 2 for its own errors.
  if(result EQUAL 0 OR (result EQUAL 4 AND NOT words MATCHES "changed:|\\[[CD]\\]|there are"))
    set(words "")
  endif()
  set(${out} "${words}" PARENT_SCOPE)
endfunction()

file(READ ${INCLUDE}/tetstream/tetstream.h header)
file(READ ${MAP} map)
describe(now "${header}" "${map}")
if(UPDATE)
  configure_file(${WORK}/now.abi ${STORED} COPYONLY)
  message(STATUS "${STORED} is up to date")
  return()
endif()
compare(${STORED} ${WORK}/now.abi words)
if(words)
  message(SEND_ERROR "the ABI has changed so that programs built before may fail:\n${words}")
endif()

# altered(NAME IS-COMPATIBLE FROM TO): what abidiff says when that text of the header is another.
function(altered name is_compatible from to)
  string(REPLACE "${from}" "${to}" other "${header}")
  if(other STREQUAL header)
    message(SEND_ERROR "${name}: the header has no \"${from}\"")
  endif()
  describe(${name} "${other}" "${map}")
  compare(${WORK}/now.abi ${WORK}/${name}.abi words)
  if(is_compatible AND words)
    message(SEND_ERROR "${name}: should do, but:\n${words}")
  elseif(NOT is_compatible AND NOT words)
    message(SEND_ERROR "${name}: was not caught")
  endif()
endfunction()

altered(another_parameter FALSE "tetstream_option_at(int32_t index" "tetstream_option_at(int64_t index")
altered(another_result FALSE "TETSTREAM_API int32_t tetstream_option_count"
  "TETSTREAM_API int64_t tetstream_option_count")
altered(a_function_less FALSE "TETSTREAM_API int32_t tetstream_option_count(void);" "")
altered(a_member_between FALSE "  int64_t cells_in, vertices_in," "  int32_t more; int64_t cells_in, vertices_in,")
altered(a_wider_member FALSE "  int32_t components;  /* 1 to 9 */" "  int64_t components;")
altered(a_callback_changed FALSE "int32_t (*next)(void *user, tetstream_batch *batch);"
  "int32_t (*next)(void *user, tetstream_batch *batch, int32_t flags);")
altered(a_member_more_without_a_size FALSE "} tetstream_column;" "  double more; } tetstream_column;")
altered(a_member_at_the_end TRUE "} tetstream_report;" "  double more; } tetstream_report;")
string(REPLACE "tetstream_option_count;" "tetstream_option_count; tetstream_option_more;" map "${map}")
altered(a_function_more TRUE "TETSTREAM_API int32_t tetstream_option_count(void);"
  "TETSTREAM_API int32_t tetstream_option_count(void);
TETSTREAM_API int32_t tetstream_option_more(int32_t which);")
