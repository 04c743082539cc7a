"""What every long program needs: text and HDF5 files, folders, locks, processes, progress, interrupts."""
