// Lambda-intervals.
