"""What stands between blocks or beside them besides contacts: each kind of element answers for itself."""
