use viewer::camera::*; use viewer::gpu::*; use viewer::scene::*; use viewer::sky::*; use viewer::stars::*;
fn main(){
 let gpu=Gpu::open().unwrap(); let sky=load(&SkySource::Nebula).unwrap();
 let field=StarField::new(&hipparcos(),0.0);
 for r in [25.0,2.0,10.0,1000.0]{ for yaw in [0.0,90.0] {
 let cam=Camera::new(&View{radius:r,yaw_deg:yaw,..View::default()}).unwrap();
 let scene=Scene::new(cam,lensbake_tables::default_atlas(),Method::Lut).unwrap();
 let plain=Renderer::new(&gpu,&sky).unwrap(); let stars=Renderer::new(&gpu,&sky).unwrap().with_stars(&field);
 let (a,b)=(plain.prepare(&scene,Output::Picture),stars.prepare(&scene,Output::Picture));
 let t=Timer::new(&gpu);
 let (mut x,mut y)=(vec![],vec![]);
 for _ in 0..12 { x.push(t.time(&a).unwrap().wall.as_secs_f64()*1e3); y.push(t.time(&b).unwrap().wall.as_secs_f64()*1e3);} 
 x.sort_by(f64::total_cmp); y.sort_by(f64::total_cmp);
 let s=std::time::Instant::now(); for _ in 0..10 { let l=viewer::stars::images::Lens::of(&scene).unwrap(); std::hint::black_box(&l);} let lens=s.elapsed().as_secs_f64()*1e2;
 let l=viewer::stars::images::Lens::of(&scene).unwrap();
 let s=std::time::Instant::now(); let n=viewer::stars::draw::arc_splats(&scene.camera,&l,&field).len(); let arcs=s.elapsed().as_secs_f64()*1e3;
 println!("r {r} yaw {yaw}: plain {:.1} ms (min {:.1}), stars {:.1} (min {:.1}); ratio {:.3}; lens {lens:.3} ms arcs {arcs:.3} ms {n} pieces; splats {}",x[6],x[0],y[6],y[0],y[6]/x[6], viewer::stars::draw::splats(&scene,&field).unwrap().len());
 }}
}
