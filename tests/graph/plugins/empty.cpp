// A library that is no plugin.
int atrium_test_nothing() { return 0; }
