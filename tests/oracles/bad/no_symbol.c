/* A shared object that is not a plug-in. */
int ts_no_symbol_here(void);
int ts_no_symbol_here(void) { return 0; }
