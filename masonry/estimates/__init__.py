"""What contact points, sections and joints lack: numbers, which remarks set against their limits."""
