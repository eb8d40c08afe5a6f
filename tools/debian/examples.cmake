# examples_<page>: command lines of a manual page, each followed by what it does. SCENES and DOCUMENTS
# name the folders in which the package has them.
set(target_step "${SCENES}/target_step.toml")
set(impedance "${DOCUMENTS}/host_sim/studies/identify/impedance/examples")
set(friction "${DOCUMENTS}/host_sim/studies/identify/friction/examples")
set(examples_sonoglide
  "sonoglide run ${target_step}" "Simulates an example scene. The result is in out/target_step."
  "sonoglide run --help" "Prints the options of a command.")
set(examples_sonoglide-run
  "sonoglide run ${target_step}" "Simulates a closed loop into out/target_step."
  "sonoglide run ${target_step} --set controller.arithmetic=q31 --out q31"
  "The same with one value replaced, into the folder q31."
  "sonoglide run --json ${target_step}" "Prints summary.json and writes no file.")
set(examples_sonoglide-pil
  "sonoglide pil ${target_step} --board mps2-an386"
  "Runs the controller as a firmware image on an emulated Cortex-M4F.")
set(examples_sonoglide-image
  "sonoglide image ${SCENES}/target_step_q31.toml --board pico --out unit.uf2"
  "Builds the unit of a scene for a Raspberry Pi Pico."
  "sonoglide image ${target_step} --board nucleo-g474re"
  "The same for a Nucleo-G474RE, into out/target_step_nucleo-g474re/unit.elf.")
set(examples_sonoglide-connect
  "sonoglide connect /dev/ttyACM0" "Talks to the unit on a serial device. The word help lists the commands."
  "echo stop | sonoglide connect /dev/ttyACM0" "Stops its drive.")
set(examples_sonoglide-commission
  "sonoglide commission /dev/ttyACM0 ${target_step}"
  "Has the unit of that scene record its plant, and writes a scene of what was found.")
set(examples_sonoglide-configure
  "sonoglide configure ${target_step} --out controller"
  "Writes controller/controller_configuration.hpp, from which an image is built.")
set(examples_sonoglide-ratio
  "sonoglide ratio --velocity-ratio 0.5 --dahl-number 4" "Prints one number.")
set(examples_sonoglide-sweep
  "sonoglide sweep ${target_step} --vary plant.stiffness_N_per_m=130e6:136e6:7"
  "Runs the scene with seven stiffnesses."
  "sonoglide sweep ${target_step} --vary controller.arithmetic=float32,q31,q15"
  "Compares arithmetics.")
set(examples_sonoglide-robust
  "sonoglide robust ${SCENES}/robust_step.toml --samples 16 --search 0"
  "Runs the loop on 16 plants within the tolerances of the scene.")
set(examples_sonoglide-paper "sonoglide paper --figure 3" "Computes one figure of the paper.")
set(examples_sonoglide-work-precision
  "sonoglide work-precision ${SCENES}/table_1_open_loop.toml" "Compares the solvers on one scene.")
set(examples_sonoglide-stability "sonoglide stability" "Takes some minutes on all cores.")
set(examples_sonoglide-arithmetic
  "sonoglide arithmetic ${target_step} --board mps2-an385"
  "Compares the arithmetics on an emulated Cortex-M3.")
set(examples_sonoglide-design
  "sonoglide design ${target_step} --ratio 0.3" "Computes the drive that a friction ratio of 0.3 needs.")
set(examples_sonoglide-identify
  "sonoglide identify friction --help" "Prints the options of one kind of measurement.")
set(examples_sonoglide-identify-impedance
  "sonoglide identify impedance ${impedance}/piece_112_kHz.csv --mass-kg 0.005"
  "Fits the equivalent circuit to a sweep, and writes a scene of the transducer.")
set(examples_sonoglide-identify-friction
  "sonoglide identify friction ${friction}/luo_2024.csv"
  "Fits every law to a published measurement and compares them.")
set(examples_sonoglide-fmu
  "sonoglide fmu ${target_step} --kind loop --out loop.fmu"
  "Writes the closed loop as a co-simulation FMU of FMI 3.")
set(examples_sonoglide-schema
  "sonoglide schema > scene.schema.json" "Writes the schema for an editor.")
set(examples_sonoglide-completion
  "sonoglide completion bash > sonoglide.bash" "Writes the script that bash is to source.")
