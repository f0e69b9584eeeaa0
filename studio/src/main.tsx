// The first paint needs only the page itself; everything else is loaded right after it.
void import("./start");
