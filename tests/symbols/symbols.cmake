# cmake -D PROGRAM=... -D ABSENT="regex" [-D PRESENT="regex"] -P symbols.cmake
# Fails if a symbol of the program matches ABSENT, or none matches PRESENT: what a scene does not name leaves no code.
execute_process(COMMAND nm -C ${PROGRAM} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "nm cannot read ${PROGRAM}")
endif()
if(PRESENT AND NOT symbols MATCHES "${PRESENT}")
  message(FATAL_ERROR "no symbol of ${PROGRAM} matches ${PRESENT}")
endif()
if(ABSENT AND symbols MATCHES "${ABSENT}")
  message(FATAL_ERROR "a symbol of ${PROGRAM} matches ${ABSENT}: ${CMAKE_MATCH_0}")
endif()
