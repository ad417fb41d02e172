# cmake -P must_fail.cmake <source> <compiler> <option>...
# Passes if the source does not compile and the compiler's output holds the text after "// expect: " of the source's first line.
set(source ${CMAKE_ARGV3})
set(command "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 4 ${last})
  list(APPEND command ${CMAKE_ARGV${i}})
endforeach()

file(READ ${source} text)
if(NOT text MATCHES "^// expect: ([^\n]+)\n")
  message(FATAL_ERROR "${source}: the first line must be `// expect: <a part of the compiler's message>`")
endif()
set(expected "${CMAKE_MATCH_1}")

set(ENV{LC_ALL} C)  # plain quotes
execute_process(COMMAND ${command} ${source} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(result EQUAL 0)
  message(FATAL_ERROR "${source} compiles, but must fail with: ${expected}")
endif()
string(FIND "${output}" "${expected}" found)
if(found EQUAL -1)
  message(FATAL_ERROR "${source} fails to compile, but not with: ${expected}\nThe compiler says:\n${output}")
endif()
