// Only in builds with sanitizers: plugins that a library loads stay until the end. Open MPI unloads
// its own, and the leak checker could then not say whose memory it is that they have left.
extern "C" int
dlclose(void *)
{
  return 0;
}
