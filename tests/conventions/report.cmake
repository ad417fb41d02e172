# Shared by the scripts of this folder. Arguments of each: <include folder> <floors.txt>.
set(include_dir ${CMAKE_ARGV3})
set(floors_file ${CMAKE_ARGV4})
file(GLOB_RECURSE headers RELATIVE ${include_dir} ${include_dir}/dmp/*.hpp)
if(NOT headers)
  message(FATAL_ERROR "no headers in ${include_dir}/dmp")
endif()

set(faults "")
macro(fault text)
  string(APPEND faults "  ${text}\n")
endmacro()

# The text of a header without its comments.
function(read_code header result)
  file(READ ${include_dir}/${header} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

function(report rule)
  if(faults)
    message(FATAL_ERROR "${rule}\n${faults}")
  endif()
endfunction()
