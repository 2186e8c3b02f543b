/* Linked into programs that look for leaks: a driver that stays loaded can be named in lsan.supp. */
int dlclose(void* library) {
    (void)library;
    return 0;
}
