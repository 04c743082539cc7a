"""Services for every long program: text and HDF5 files, folders, locks, processes, progress, interrupts."""
