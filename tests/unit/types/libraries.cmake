list(APPEND alone flat_test.cpp)
