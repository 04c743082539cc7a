"""The bodies of one kind of motion, in small displacement or in large: how they move and what they hold."""
