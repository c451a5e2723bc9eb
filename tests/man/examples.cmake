# Takes the literal blocks after "Sh EXAMPLES" out of the pages of section 3 and compiles them: a
# block with a main as it is, others inside a function with the handles that they speak of. Those of
# tetstream-python(3) are for tests/python.
cmake_minimum_required(VERSION 3.25)

set(before "#include <stdio.h>
#include <tetstream/tetstream.h>
int solve_next_slab(tetstream_batch *);
void example(tetstream_options *options, tetstream_writer *writer, tetstream_stream_info info,
             tetstream_batch batch);
")
set(open "void example(tetstream_options *options, tetstream_writer *writer,
                       tetstream_stream_info info, tetstream_batch batch) {
  (void)options; (void)writer; (void)info; (void)batch; {
")

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
file(GLOB pages ${MAN}/man3/tetstream.3 ${MAN}/man3/tetstream_*.3)
set(compiled 0)
foreach(page IN LISTS pages)
  file(READ ${page} text)
  # note: CMake's lists end at ";" and its regular expressions know no "shortest match".
  string(FIND "${text}" "\n.Sh EXAMPLES" start)
  if(start EQUAL -1)
    continue()
  endif()
  string(SUBSTRING "${text}" ${start} -1 rest)
  while(TRUE)
    string(FIND "${rest}" ".Bd -literal" start)
    string(FIND "${rest}" ".Ed" end)
    if(start EQUAL -1 OR end EQUAL -1)
      break()
    endif()
    math(EXPR length "${end} - ${start}")
    string(SUBSTRING "${rest}" ${start} ${length} block)
    math(EXPR end "${end} + 3")
    string(SUBSTRING "${rest}" ${end} -1 rest)
    string(REGEX REPLACE "^[^\n]*\n" "" block "${block}")
    string(REPLACE "\\en" "\\n" block "${block}")
    math(EXPR compiled "${compiled} + 1")
    set(file ${WORK}/example_${compiled}.c)
    if(block MATCHES "int main")
      file(WRITE ${file} "${block}")
    elseif(block MATCHES "\n\\\\&\\.\\.\\.\n")
      # Functions first, then what calls them.
      string(REPLACE "\n\\&...\n" "\n${open}" block "${block}")
      file(WRITE ${file} "${before}${block}}}\n")
    else()
      file(WRITE ${file} "${before}${open}${block}}}\n")
    endif()
    execute_process(COMMAND ${CC} -std=c99 -Wall -Werror -Wno-unused-variable
      -Wno-missing-field-initializers -fsyntax-only -I${INCLUDE} ${file}
      RESULT_VARIABLE result ERROR_VARIABLE errors)
    if(NOT result EQUAL 0)
      message(SEND_ERROR "${page}: an example does not compile:\n${errors}")
    endif()
  endwhile()
endforeach()
if(compiled LESS 6)
  message(SEND_ERROR "only ${compiled} examples were found")
endif()
