# Writes the commit of a source tree, and whether more than docs/ was changed since, as a C++ header if that is news:
# cmake -DGIT=git -DSOURCE=tree -DHEADER=out.h -P commit.cmake
cmake_minimum_required(VERSION 3.25)
set(commit "")
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --abbrev=10 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # Scripts that measure write there, one after the other.
  execute_process(COMMAND ${GIT} -C ${SOURCE} diff --quiet HEAD -- . :!docs RESULT_VARIABLE changed ERROR_QUIET)
  if(commit AND changed)
    string(APPEND commit "-dirty")
  endif()
endif()
if(commit STREQUAL "")
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define TRISECT_COMMIT \"@commit@\"\n" @ONLY)
