# The driver with the simulated ERS-7 and all programs, built on Debian 13. scripts/container builds this and runs it.
FROM debian:trixie-slim

COPY . /aibo_driver
WORKDIR /aibo_driver
RUN scripts/install_dependencies build && scripts/build && rm -rf /var/lib/apt/lists/*

ENTRYPOINT ["bash", "-c", "source .build/devel/setup.bash && exec \"$@\"", "bash"]
CMD ["scripts/demo"]
