#version 450
// Has nothing to do: tessellated.tese reads the triangle by its index.
void main() {}
