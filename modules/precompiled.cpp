// Nothing: the target that it is compiled for makes the header that the modules share.
