# Writes commit.h with the short commit id (and "+" when the working tree differs from it); leaves it untouched
# when nothing changed, so that nothing is rebuilt.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+ --abbrev=10 OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#pragma once\n#define BOUNCE_COMMIT \"${commit}\"\n")
