// Compiled for the headers that every test includes.
