# Writes a SPIR-V file as a C++ array of words: cmake -DBINARY=in.spv -DHEADER=out.h -DNAME=array -P embed.cmake
file(READ ${BINARY} bytes HEX)
# SPIR-V as glslang writes it here is little-endian: the first byte of a word is its last two digits.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${bytes}")
file(WRITE ${HEADER} "const uint32_t ${NAME}[] = {\n${words}};\n")
