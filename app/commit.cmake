# Writes commit.h with the short commit id, and "+" when the working tree differs from it: with a digest of the
# difference where it is in what is compiled, so that two such programs are told apart. Leaves the file untouched when
# nothing changed, so that nothing is rebuilt.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+ --abbrev=10 OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
set(compiled app passes third_party CMakeLists.txt)
execute_process(COMMAND git -C ${SOURCE} diff HEAD -- ${compiled} OUTPUT_VARIABLE difference ERROR_QUIET)
execute_process(COMMAND git -C ${SOURCE} ls-files --others --exclude-standard -- ${compiled} OUTPUT_VARIABLE added
  ERROR_QUIET)
if(difference OR added)
  string(SHA1 digest "${difference}${added}")
  string(SUBSTRING ${digest} 0 8 digest)
  string(REPLACE "+" "" commit ${commit})
  set(commit "${commit}+${digest}")
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#pragma once\n#define BOUNCE_COMMIT \"${commit}\"\n")
