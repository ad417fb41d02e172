# Where a family has a catalogue, it lists every law of the family with a sentence about it.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/report.cmake)

foreach(header IN LISTS headers)
  if(header MATCHES "/(concept|mean)\\.hpp$" OR NOT header MATCHES "^dmp/([^/]+)/[^/]+\\.hpp$")
    continue()  # a catalogue, something in detail/, or no law
  endif()
  set(catalogue dmp/${CMAKE_MATCH_1}.hpp)
  if(EXISTS ${include_dir}/${catalogue})
    file(READ ${include_dir}/${catalogue} text)
    string(REPLACE "." "\\." pattern ${header})
    if(NOT text MATCHES "#include <${pattern}> +// [^\n]+")
      fault("${catalogue} lacks the line: #include <${header}>  // what it is good for")
    endif()
  endif()
endforeach()

report("Laws are missing from their catalogue:")
