// The first paint needs nothing but the page itself; all the rest comes at once behind it.
void import("./start");
