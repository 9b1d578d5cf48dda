/* A shared object, and no plug-in. */
int ts_no_symbol_here(void);
int ts_no_symbol_here(void) { return 0; }
