#version 450
// Nothing: tessellated.tese knows its triangle by number.
void main() {}
