// Depth of what the light sees, for materials without alpha test.
void main() {}
