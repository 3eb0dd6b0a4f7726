# Installs the package into a folder of its own, builds the consumer against it and renders a frame with it.
#   cmake -DBUILD=... -DSOURCE=... -DFOLDER=... -DCOMPILER=... -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/installed)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER}/build -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${FOLDER}/installed -DCMAKE_CXX_FLAGS=-Werror)
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${FOLDER}/build/consumer ${FOLDER}/octahedron.png)
message("${output}")
if(NOT EXISTS ${FOLDER}/octahedron.png)
  message(FATAL_ERROR "the consumer wrote no picture")
endif()
# The library brings neither a command line nor a window along.
run(ldd ${FOLDER}/build/consumer)
foreach(library glfw imgui glslang CLI11)
  if(output MATCHES ${library})
    message(FATAL_ERROR "the consumer links ${library}:\n${output}")
  endif()
endforeach()
# The installed program runs from where it is.
run(${FOLDER}/installed/bin/trisect --version)
